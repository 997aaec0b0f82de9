// The byte shuffles of OpenEXR's ZIP and RLE chunks, as functions that a faster room may replace.
//
// image/ knows no SIMD; its own codecs are plain loops, and the twin of what kernels/ offers.
#pragma once

#include <cstddef>

namespace shoal {

struct ChunkCodecs {
  // Undoes OpenEXR's predictor (each byte is the difference to its predecessor, plus 128) and then
  // its split of a chunk into its even bytes (first half) and odd bytes (second half).
  // `in` may be changed. `out` does not overlap it. Both hold `size` bytes.
  void (*undo_predictor_and_split)(std::byte* in, std::size_t size, std::byte* out);
};

// Plain loops, one byte after another.
[[nodiscard]] ChunkCodecs portable_chunk_codecs();

}  // namespace shoal
