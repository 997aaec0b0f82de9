// What a panorama's coefficients say of its light, in a few numbers.
#pragma once

#include <glm/vec3.hpp>
#include <optional>

#include "library/library.h"

namespace shoal::viz {

struct LightFigures {
  glm::dvec3 mean{0.0};       // radiance, over the sphere: L_00 / sqrt(4 pi)
  double mean_luminance = 0;  // of that
  QualityFigures quality;     // the store's, or sphere/light_quality.h of the coefficients
  // Of the dominant light (sphere/dominant_light.h), native frame, unit length.
  std::optional<glm::dvec3> direction;
};

// Precondition: the coefficients are finite.
[[nodiscard]] LightFigures light_figures(const Panorama& panorama);

// Degrees above the horizon of the panorama's picture, [-90, 90].
[[nodiscard]] double elevation_of(const glm::dvec3& native);

// Degrees to the right of the picture's centre, (-180, 180].
[[nodiscard]] double azimuth_of(const glm::dvec3& native);

}  // namespace shoal::viz
