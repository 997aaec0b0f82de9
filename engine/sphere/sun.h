// The sun of a panorama, told as what a light is told by.
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>

#include "sphere/analytic_lights.h"

namespace shoal {

// What stands out of the level around the brightest texel. A texel whose largest channel v is above
// the level is its sample times level/v, which stays, and the rest, which is the sun's: so both
// have the texel's colour. Radiometric quantities are of that rest, in linear Rec.709.
struct Sun {
  glm::dvec3 direction{0.0, 0.0, 1.0};  // unit, native frame: the centroid of its light
  double solid_angle = 0.0;             // sr, of its texels
  double angular_radius = 0.0;          // radians, of a disk of that solid angle
  glm::dvec3 irradiance{0.0};           // of a surface that faces it
  glm::dvec3 flux{0.0};                 // integral of its radiance over the sphere
  double level = 0.0;                   // in the file's own samples
  double share = 0.0;                   // of the luminance of the panorama's flux, before any clamp
  std::int64_t texel_count = 0;

  [[nodiscard]] glm::dvec3 mean_radiance() const { return flux / solid_angle; }
  // The uniform disk of that direction, radius and flux: what is put back is what was taken. A
  // facing surface gets its irradiance but for O(radius^2) of it.
  [[nodiscard]] DiskLight disk() const;

  friend bool operator==(const Sun&, const Sun&) = default;
};

}  // namespace shoal
