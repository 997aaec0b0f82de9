// What a panorama's coefficients say of its light, in a few numbers.
#pragma once

#include <glm/vec3.hpp>
#include <optional>

#include "sphere/coefficients.h"

namespace shoal::viz {

// Irradiance is looked at in kFigureRows x 2 kFigureRows directions, an equirect picture's texel
// centres. An extremum between them is missed by at most L^2 (pi / kFigureRows)^2 / 4 of max |E|, L
// the degree: Bernstein's inequality bounds the second derivative along a great circle by L^2.
inline constexpr int kFigureRows = 64;

struct LightFigures {
  glm::dvec3 mean{0.0};       // radiance, over the sphere: L_00 / sqrt(4 pi)
  double mean_luminance = 0;  // of that

  // Of the luminance's irradiance, in all directions and at all degrees there are.
  double minimum_irradiance = 0;
  double maximum_irradiance = 0;
  double negative_fraction = 0;  // of the sphere's area, where it is below zero

  // (max - min) / (max + min) of the irradiance: 0 for a constant environment, 1 where a direction
  // gets nothing. Not where max + min is not positive.
  std::optional<double> contrast;

  std::optional<double> dominance;  // dominance_of

  // Where dominant_vector points, native frame, unit length; not where it is zero.
  std::optional<glm::dvec3> direction;
};

// Precondition: the coefficients are finite.
[[nodiscard]] LightFigures light_figures(const Coefficients& radiance);

// Degrees above the horizon of the panorama's picture, [-90, 90].
[[nodiscard]] double elevation_of(const glm::dvec3& native);

// Degrees to the right of the picture's centre, (-180, 180].
[[nodiscard]] double azimuth_of(const glm::dvec3& native);

}  // namespace shoal::viz
