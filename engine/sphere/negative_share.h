// How much of the sphere lies where a function is below zero.
#pragma once

#include <span>

namespace shoal {

// Part of 1. `coefficients`: (degree+1)^2, index order. The function is taken as linear on the
// triangles of an equirect grid of 256 to 512 rows, by the degree, so that a boundary is placed to
// the second order: for the irradiance of a directional light, which rings the most, to 1.1e-4 at
// every degree, and to 5e-5 at degrees 0 to 5. Where the function is zero all over a region,
// rounding decides. Bits do not depend on the processor.
[[nodiscard]] double negative_share(std::span<const double> coefficients, int degree);

}  // namespace shoal
