// The two-dimensional wavelet of PIZ chunks, undone by a plain loop: the twin of kernels/wavelet.h.
#pragma once

#include <cstddef>
#include <cstdint>

namespace shoal {

// As kernels::undo_wavelet, one group of neighbours after another.
void undo_exr_wavelet(std::uint16_t* samples, std::size_t width, std::size_t height,
                      std::size_t interleaved, std::uint16_t greatest);

}  // namespace shoal
