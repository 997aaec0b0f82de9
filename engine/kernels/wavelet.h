// The two-dimensional wavelet of OpenEXR's PIZ chunks, undone in SIMD.
#pragma once

#include <cstddef>
#include <cstdint>

namespace shoal::kernels {

// Undoes in place, level after level from the coarsest, the Haar-like wavelet of `height` rows of
// `width` columns of `interleaved` (1 or 2) planes: plane j of row y, column x lies at
// samples[(y * width + x) * interleaved + j]. If no sample before the wavelet was above `greatest`,
// it worked on 14 bits where those suffice (greatest < 2^14), else modulo 2^16.
void undo_wavelet(std::uint16_t* samples, std::size_t width, std::size_t height,
                  std::size_t interleaved, std::uint16_t greatest);

}  // namespace shoal::kernels
