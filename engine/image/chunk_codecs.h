// The inner loops of OpenEXR's ZIP, RLE, PIZ and PXR24 chunks, as functions that a faster room may
// replace.
//
// image/ knows no SIMD; its own codecs are plain loops, and the twin of what kernels/ offers.
#pragma once

#include <cstddef>
#include <cstdint>

namespace shoal {

// The plain loop of ChunkCodecs::sum_planes.
void sum_exr_planes(const std::byte* planes, std::size_t plane_count, std::size_t count,
                    std::byte* out);

struct ChunkCodecs {
  // Undoes OpenEXR's predictor (each byte is the difference to its predecessor, plus 128) and then
  // its split of a chunk into its even bytes (first half) and odd bytes (second half).
  // `in` may be changed. `out` does not overlap it. Both hold `size` bytes.
  void (*undo_predictor_and_split)(std::byte* in, std::size_t size, std::byte* out);

  // Undoes the wavelet of PIZ, as kernels::undo_wavelet.
  void (*undo_exr_wavelet)(std::uint16_t* samples, std::size_t width, std::size_t height,
                           std::size_t interleaved, std::uint16_t greatest);

  // Undoes PXR24's differences in a line of `count` samples: the running sums, modulo 2^16 or 2^32,
  // of what `plane_count` planes of `count` bytes hold, the highest byte first. 2 planes make
  // 16-bit samples, 4 make 32-bit ones, and so do 3, whose lowest byte is zero. `out` does not
  // overlap.
  void (*sum_planes)(const std::byte* planes, std::size_t plane_count, std::size_t count,
                     std::byte* out) = &sum_exr_planes;
};

// Plain loops, one sample after another.
[[nodiscard]] ChunkCodecs portable_chunk_codecs();

}  // namespace shoal
