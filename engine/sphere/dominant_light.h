// A panorama's light told as one directional light and the rest.
#pragma once

#include <glm/vec3.hpp>
#include <optional>

#include "sphere/analytic_lights.h"
#include "sphere/coefficients.h"

namespace shoal {

struct DominantLight {
  DirectionalLight light;  // unit direction in the coefficients' frame; no component is negative
  Coefficients projected;  // its coefficients, to the degree of the panorama's
  Coefficients residual;   // the panorama without it
  // |integral of luminance(L) w dw| / integral of luminance(L) dw. For light that is nowhere
  // negative in [0, 1]: 0 where it comes evenly from all around, 1 where it all comes from one
  // direction. Not finite where the mean luminance is zero.
  double directionality = 0.0;
  // 1 - ||residual||^2 / ||panorama||^2 over channels and all coefficients to the fitted degree:
  // the part of their energy that the light explains, in [0, 1].
  double energy_share = 0.0;
};

// Direction: of the luminance's degree-1 vector (L_11, L_1-1, L_10), which is the integral of
// luminance times direction. Colour, a channel: the irradiance e that brings e Y_lm(direction)
// nearest to L_lm in least squares over l <= fit_degree,
//   e = sum L_lm Y_lm(d) / sum Y_lm(d)^2,   sum Y_lm(d)^2 = (fit_degree+1)^2 / (4 pi),
// or 0 where that is negative. Source: Sloan, "Stupid Spherical Harmonics (SH) Tricks", GDC 2008,
// "Extracting Dominant Light". The light is then taken off at every degree of the coefficients.
//
// projected + residual is radiance, coefficient by coefficient, to the last bit that doubles allow:
// equal wherever |projected| <= |radiance|; where the light's coefficient is the larger one, to one
// unit in its last place, which is all that doubles of that size can hold. For this `projected` may
// differ from project_lights of the same light by one rounding of the residual.
//
// Nothing where no direction stands out: degree 0, or a vector shorter than 1e-12 of L_00.
// Precondition: 0 <= fit_degree; degrees above the coefficients' are not looked at.
[[nodiscard]] std::optional<DominantLight> dominant_light(const Coefficients& radiance,
                                                          int fit_degree);

}  // namespace shoal
