// Decodes the Huffman-coded symbols of a PIZ chunk, several stretches of it at a time.
//
// Where a code begins is known only once the code before it is read: a chain of table look-ups,
// each of which waits for the last one. So a chunk is cut into stretches of equally many bits,
// which are decoded side by side. All but the first begin at a guess, in the middle of some code,
// but a prefix code soon falls into step: once a code begins where one begins in truth, all later
// ones do. Each stretch is decoded on to where it meets the next one in step; what that one holds
// from there on is what a single decoder would have found, bit for bit. (Self-synchronisation:
// Klein and Wiseman, Parallel Huffman decoding with applications to JPEG files, 2003.)
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "core/aligned_buffer.h"
#include "image/exr_huffman_code.h"

namespace shoal {

class PizHuffmanDecoder {
 public:
  // A 4096x2048 half picture expands in 86 ms with 1, 53 with 2, 46 with 3, 45 with 4 (Zen 4).
  static constexpr std::size_t kStretches = 4;

  // Decodes what `packed` holds: first and last symbol, three more numbers, the code, its bits.
  // False if these are damaged, as they are unless their last code fills `symbols`.
  bool decode(std::span<const std::byte> packed, std::span<std::uint16_t> symbols);

 private:
  bool decode_bits(std::span<const std::byte> bytes, std::uint64_t bit_count,
                   std::span<std::uint16_t> symbols);

  ExrHuffmanCode code_;
  AlignedBuffer<std::uint16_t> scratch_;  // of the stretches but the first
};

}  // namespace shoal
