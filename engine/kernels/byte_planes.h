// The byte shuffles of OpenEXR's ZIP and RLE chunks, in SIMD.
#pragma once

#include <cstddef>

namespace shoal::kernels {

// Undoes OpenEXR's predictor, t[i] = t[i-1] + in[i] - 128, then its split of the bytes into the
// even ones (first half, the longer one) and the odd ones: out[2k] = t[k], out[2k+1] =
// t[ceil(size/2)+k]. `out` does not overlap `in`; both hold `size` bytes.
void undo_predictor_and_split(std::byte* in, std::size_t size, std::byte* out);

}  // namespace shoal::kernels
