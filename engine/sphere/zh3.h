// Irradiance from few numbers: what can be had beyond degree 1 without storing all of degree 2.
//
// Sources: Roughton, Sloan, Silvennoinen, Iwanicki, Shirley, "ZH3: Quadratic Zonal Harmonics",
// Proc. ACM Comput. Graph. Interact. Tech. 7 (2024); Hazel & Doran's non-linear model of irradiance
// from degree 1, made at Geomerics, as told in Hazel, "Converting SH Radiance to Irradiance"
// (grahamhazel.com, 2017).
#pragma once

#include <glm/vec3.hpp>

#include "sphere/coefficients.h"

namespace shoal {

// Radiance to degree 1 and, in each channel, one coefficient q of the quadratic zonal harmonic
// Z(x) = sqrt(5/(16 pi)) (3 (a.x)^2 - 1) about an axis a that the channels share: 15 numbers, the
// axis following from the others.
struct QuadraticZonal {
  Coefficients linear{1};          // L_lm to degree 1
  glm::dvec3 axis{0.0, 0.0, 1.0};  // unit: the luminance's degree-1 vector; +z where it is zero
  glm::dvec3 quadratic{0.0};       // q, RGB
};

// The q nearest to the degree-2 coefficients in least squares, q = sqrt(4 pi/5) sum_m L_2m Y_2m(a).
// Exact for light that is symmetric about its luminance's axis. Precondition: degree >= 2.
[[nodiscard]] QuadraticZonal fit_zh3(const Coefficients& radiance);

// q guessed from degree 1 alone ("hallucinated"): q = L_00 (0.08 r + 0.6 r^2),
// r = |a . (L_11, L_1-1, L_10)| / L_00, the paper's fit; 0 in a channel whose L_00 is not positive.
// For a directional light r = sqrt(3) and q is 0.867 of the true one. Precondition: degree >= 1.
[[nodiscard]] QuadraticZonal hallucinate_zh3(const Coefficients& radiance);

// The same light as coefficients to degree 2: L_2m = q sqrt(4 pi/5) Y_2m(a). Irradiance and all
// else follow from them.
[[nodiscard]] Coefficients expand(const QuadraticZonal& light);

// Irradiance in a unit direction, RGB, from degree 1 by the non-linear model: with the mean
// radiance R0 = L_00/sqrt(4 pi), the vector R1 = (L_11, L_1-1, L_10)/sqrt(12 pi), r = |R1|/R0 and
// t = (1 + n.R1/|R1|)/2,
//   E(n) = pi R0 (k + (1-k) (p+1) t^p),   p = 1 + 2r,   k = (1-r)/(1+r).
// For radiance that is nowhere negative r <= 1, and then E is nowhere negative; its mean is exact,
// and so is E(n) - E(-n) along R1; a directional light's greatest and least irradiance are exact. r
// is held at 1 where it is above. 0 in a channel whose L_00 is not positive. Precondition: degree
// >= 1.
[[nodiscard]] glm::dvec3 nonlinear_irradiance(const Coefficients& radiance,
                                              const glm::dvec3& direction);

}  // namespace shoal
