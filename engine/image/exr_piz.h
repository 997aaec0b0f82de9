// Expands the chunks of EXR's PIZ compression.
//
// A chunk's samples are taken as 16-bit values, floats and integers as two, low half first. Those
// that occur are numbered in order; the numbers go through a wavelet, channel after channel, and
// the outcome is Huffman-coded. Here in reverse. (The layout: OpenEXR's technical introduction, and
// the PIZ compressor of its library.)
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

#include "core/aligned_buffer.h"
#include "image/chunk_codecs.h"
#include "image/exr_expansion.h"
#include "image/exr_piz_huffman.h"

namespace shoal {

class PizExpander {
 public:
  explicit PizExpander(const ChunkCodecs& codecs) : codecs_(codecs) {}

  // Expands `packed` to the chunk as it is without compression. Damaged unless everything in it is
  // as a writer makes it and fills `out`, which is as large as `shape` says.
  // The scratch memory grows to four times the largest chunk met, of which half is used as a rule.
  Expansion expand(std::span<const std::byte> packed, const ExrChunkShape& shape,
                   std::span<std::byte> out);

 private:
  [[nodiscard]] std::optional<std::size_t> read_values(std::span<const std::byte> packed);
  void undo_wavelets(const ExrChunkShape& shape);
  void place(const ExrChunkShape& shape, std::byte* out) const;

  ChunkCodecs codecs_;
  PizHuffmanDecoder huffman_;
  AlignedBuffer<std::uint16_t> numbers_;       // channel after channel
  std::array<std::uint16_t, 65536> values_{};  // of the numbers; 0 for those that do not occur
  std::uint16_t greatest_ = 0;                 // number
};

}  // namespace shoal
