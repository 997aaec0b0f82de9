// Functions on the sphere as equirect pictures.
#pragma once

#include <vector>

#include "library/pixels.h"
#include "sphere/coefficients.h"

namespace shoal::viz {

// The function at the centres of width x height texels of the native frame, to which the
// coefficients belong. Row by row: Legendre sums a row and order, then a Fourier sum.
// Precondition: both are positive.
[[nodiscard]] Pixels synthesise(const Coefficients& native, int width, int height);

// The mean over the sphere of f, which has a value a texel of `like`: rows weigh as the solid
// angles of their texels do.
[[nodiscard]] double sphere_mean(const Pixels& like, const std::vector<double>& values);

}  // namespace shoal::viz
