// A panorama's light told as one directional light and the rest.
#pragma once

#include <glm/vec3.hpp>
#include <optional>

#include "sphere/analytic_lights.h"
#include "sphere/coefficients.h"

namespace shoal {

// The degrees that decide irradiance: those to 2 hold more than 99 % of its energy, on the average
// over light from anywhere (Ramamoorthi & Hanrahan, "An Efficient Representation for Irradiance
// Environment Maps", SIGGRAPH 2001).
inline constexpr int kDominantFitDegree = 2;

struct DominantLight {
  DirectionalLight light;  // unit direction in the coefficients' frame; no component is negative
  Coefficients projected;  // its coefficients, to the degree of the panorama's
  Coefficients residual;   // the panorama without it
  // |integral of luminance(L) w dw| / integral of luminance(L) dw. For light that is nowhere
  // negative in [0, 1]: 0 where it comes evenly from all around, 1 where it all comes from one
  // direction. Not finite where the mean luminance is zero.
  double directionality = 0.0;
  // 1 - ||residual||^2 / ||panorama||^2 over channels and the coefficients that the light is fitted
  // to: the part of their energy that it explains, in [0, 1].
  double energy_share = 0.0;
};

// Direction: of the luminance's degree-1 vector (L_11, L_1-1, L_10), which is the integral of
// luminance times direction. Colour, a channel: the irradiance e that brings e Y_lm(direction)
// nearest to L_lm in least squares over l <= n, n = min(degree, kDominantFitDegree),
//   e = sum L_lm Y_lm(d) / sum Y_lm(d)^2,   sum Y_lm(d)^2 = (n+1)^2 / (4 pi),
// or 0 where that is negative. Source: Sloan, "Stupid Spherical Harmonics (SH) Tricks", GDC 2008,
// "Extracting Dominant Light". Higher degrees have no part in the fit, so that the light is the
// same at every degree from 2 on: a point's light is as strong at each of them, a panorama's is
// not, and fitted to it the colour would go to black as the degree grows. The light is then taken
// off at every degree of the coefficients.
//
// projected + residual is radiance, coefficient by coefficient, to the last bit that doubles allow:
// equal wherever |projected| <= |radiance|; where the light's coefficient is the larger one, to one
// unit in its last place, which is all that doubles of that size can hold. For this `projected` may
// differ from project_lights of the same light by one rounding of the residual.
//
// Nothing where no direction stands out: degree 0, or a vector shorter than 1e-12 of L_00.
[[nodiscard]] std::optional<DominantLight> dominant_light(const Coefficients& radiance);

}  // namespace shoal
