// The byte shuffles of OpenEXR's ZIP, RLE and PXR24 chunks, in SIMD.
#pragma once

#include <cstddef>

namespace shoal::kernels {

// Undoes OpenEXR's predictor, t[i] = t[i-1] + in[i] - 128, then its split of the bytes into the
// even ones (first half, the longer one) and the odd ones: out[2k] = t[k], out[2k+1] =
// t[ceil(size/2)+k]. `out` does not overlap `in`; both hold `size` bytes.
void undo_predictor_and_split(std::byte* in, std::size_t size, std::byte* out);

// Undoes PXR24's differences in a line of samples: sample i is the sum, modulo 2^16 or 2^32, of the
// numbers 0 to i whose bytes lie in planes of `count` bytes, the highest first. plane_count 2:
// 16-bit samples; 4: 32-bit ones; 3: 32-bit ones whose lowest byte is zero. `out` does not overlap
// `planes`.
void sum_planes(const std::byte* planes, std::size_t plane_count, std::size_t count,
                std::byte* out);

}  // namespace shoal::kernels
