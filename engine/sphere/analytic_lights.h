// Lights in closed form: their radiance is known in every direction, and so is every coefficient.
//
// All but the ambient one are symmetric about an axis d. By the Funk-Hecke theorem such a light
// f(cos(angle to d)) has L_lm = k_l Y_lm(d), k_l = 2 pi times the integral of f(t) P_l(t) over
// [-1, 1] (Ramamoorthi & Hanrahan, "On the relationship between radiance and irradiance", J. Opt.
// Soc. Am. A 18 (2001), eq. 19-20). Here k_l are a light's zonal factors.
#pragma once

#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>
#include <optional>
#include <span>
#include <variant>
#include <vector>

#include "core/result.h"
#include "sphere/coefficients.h"

namespace shoal {

// Directions point from the surface to the light. They need not be of unit length. Every light has
// a default that puts nothing anywhere, so that fields may be filled in one after the other.
// Components of radiance and irradiance, linear RGB, may be negative: a light can be taken away.

// The same radiance from everywhere: L_00 = sqrt(4 pi) radiance.
struct AmbientLight {
  glm::dvec3 radiance{0.0};
};

// All light from one direction: k_l = 1. `irradiance` is what a surface that faces it gets.
struct DirectionalLight {
  glm::dvec3 direction{0.0, 0.0, 1.0};
  glm::dvec3 irradiance{0.0};
};

// A uniform disk or cap: `radiance` within `angular_radius` of the direction, nothing outside.
// Radians, in (0, pi]; pi/2 is a hemisphere, pi is ambient light. A facing surface gets
// pi sin^2(angular_radius) radiance as long as that is at most pi/2.
struct DiskLight {
  glm::dvec3 direction{0.0, 0.0, 1.0};
  double angular_radius = 0.0;
  glm::dvec3 radiance{0.0};
};

// max(0, cos(angle to the direction)) times the radiance at its axis: k_l = A_l of the clamped
// cosine. A facing surface gets 2 pi/3 radiance.
struct CosineLobe {
  glm::dvec3 direction{0.0, 0.0, 1.0};
  glm::dvec3 radiance{0.0};
};

using AnalyticLight = std::variant<AmbientLight, DirectionalLight, DiskLight, CosineLobe>;

// The lights that have a radiance in every direction. A directional light has none: it would be
// infinite in its own.
using PaintableLight = std::variant<AmbientLight, DiskLight, CosineLobe>;

// Errors: usage, where a direction is zero or not finite, a radius is not in (0, pi], a radiance or
// irradiance is not finite.
[[nodiscard]] Status check_light(const AnalyticLight& light);

// k_0 .. k_degree of a cap of radiance 1: 2 pi (1 - cos a) and, for l >= 1,
//   2 pi (P_(l-1)(cos a) - P_(l+1)(cos a)) / (2l+1) = 2 pi sin^2(a) P_l'(cos a) / (l (l+1)),
// the latter form, which loses nothing where the cap is small. Error: 1e-15 of k_0, however small
// the cap. Preconditions: 0 < angular_radius <= pi, 0 <= degree <= kMaxDegree.
[[nodiscard]] std::vector<double> cap_zonal_factors(double angular_radius, int degree);

// k_0 .. k_degree of a light of radiance (a directional one: irradiance) 1; 4 pi, 0, 0 ... for the
// ambient one. Preconditions: check_light, 0 <= degree <= kMaxDegree.
[[nodiscard]] std::vector<double> zonal_factors(const AnalyticLight& light, int degree);

// The radiance coefficients of all the lights together, summed in their order, in the frame that
// their directions are given in. Error of a light's L_lm: 1e-13 of k_0 max|Y_lm|.
// Preconditions: check_light of each, 0 <= degree <= kMaxDegree.
[[nodiscard]] Coefficients project_lights(std::span<const AnalyticLight> lights, int degree);

// The light with x replaced by R x: coefficients of the turned light are the rotated coefficients
// (sphere/rotation.h). The transpose of native_to_frame (sphere/frame.h) brings a light that is
// told in a frame to the native one. Precondition: R orthogonal.
[[nodiscard]] AnalyticLight turned(AnalyticLight light, const glm::dmat3& orthogonal);

// The light as one that can be painted; none for a directional light.
[[nodiscard]] std::optional<PaintableLight> paintable(const AnalyticLight& light);

// The light's radiance in a unit direction, linear RGB. Precondition: check_light.
[[nodiscard]] glm::dvec3 radiance_at(const PaintableLight& light, const glm::dvec3& direction);

}  // namespace shoal
