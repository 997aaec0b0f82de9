// How far irradiance to a low degree is from what a surface really gets: the convolution of the
// light with the clamped cosine, which no degree ends.
#pragma once

#include <glm/vec3.hpp>
#include <optional>
#include <span>

#include "sphere/coefficients.h"
#include "sphere/direction_grid.h"

namespace shoal {

struct IrradianceError {
  int degree = 0;  // to which the exact irradiance is known; a window's own error counts, too
  // ||E - E_exact|| / ||E_exact||, L2 over the sphere and the channels.
  double relative_rms = 0.0;
  // The largest |E - E_exact| over directions and channels, each channel in units of its own mean
  // irradiance; channels whose mean is not positive count for nothing.
  double maximum = 0.0;
  glm::dvec3 direction{0.0, 0.0, 1.0};  // where; unit, in the coefficients' frame

  friend bool operator==(const IrradianceError&, const IrradianceError&) = default;
};

// Of the irradiance that `approximate`, radiance to some degree and with its window, stands for,
// against that of `exact`, the same light to a higher degree Q and without a window. Both by
// Parseval's theorem, so free of any sampling:
//   ||E - E_exact||^2 = sum_lm A_l^2 (L_lm - L_lm exact)^2.
// The maximum is looked for on a grid of 4 (Q+1) rows and refined. What degrees above Q hold is
// left out: see irradiance_beyond(). Nothing where the exact irradiance is zero. Precondition: the
// exact degree is at least the other.
[[nodiscard]] std::optional<IrradianceError> irradiance_error(const Coefficients& approximate,
                                                              const Coefficients& exact);

// The same against irradiance that is known at the grid's directions (3 channels each), by the
// grid's quadrature; the means are the grid's. `degree` of the result: that of the quadrature,
// 2 rows - 1.
[[nodiscard]] std::optional<IrradianceError> irradiance_error(
    const Coefficients& approximate, const DirectionGrid& grid,
    std::span<const glm::dvec3> irradiance);

// The most that the degrees above Q can hold of the irradiance of light that is nowhere negative,
// in units of its mean. A lone directional light reaches both, at right angles to it the second:
//   root_mean_square = 4 sqrt((2 pi/3 - sum_{l<=Q} A_l^2 (2l+1)/(4 pi)) / (4 pi))
//   maximum          = 4 |sum_{l<=Q} A_l (2l+1)/(4 pi) P_l(0)|
// since the remainder is the light, of flux 4 times its mean irradiance, seen through the remainder
// of the clamped cosine. Real panoramas hold far less: they are mostly even light.
struct IrradianceBeyond {
  double root_mean_square = 0.0;
  double maximum = 0.0;
};
[[nodiscard]] IrradianceBeyond irradiance_beyond(int degree);

}  // namespace shoal
