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
  double angular_radius = 0.0;          // radians, of disk()
  glm::dvec3 irradiance{0.0};           // of a surface that faces it
  glm::dvec3 flux{0.0};                 // integral of its radiance over the sphere
  double level = 0.0;                   // in the file's own samples
  double share = 0.0;                   // of the luminance of the panorama's flux, before any clamp
  std::int64_t texel_count = 0;

  // The uniform disk of that direction, flux and spread: what is put back is what was taken. Its
  // radius is not that of the texels, many of which may hold little light, but see disk_radius().
  [[nodiscard]] DiskLight disk() const;

  friend bool operator==(const Sun&, const Sun&) = default;
};

// The angular radius of the uniform disk whose light is spread as a light's is: `spread` is the
// mean of |w - d|^2 over the light's flux, w where it comes from and d the light's direction, in
// (0, 2]. Over a cap of radius a, cos(angle to the axis) has the mean (1 + cos a)/2, so
//   1 - cos a = spread,
// which for small ones is the mean square angle a^2/2. A facing surface gets
// flux (1 - spread/2) of either, so the disk has the light's irradiance too.
[[nodiscard]] double disk_radius(double spread);

// What a texel of a solid angle (sr), that looks along w, brings to that mean: of a cap of that
// solid angle, that is |w - d|^2 + (w . d) solid_angle/(2 pi), exactly. A square of side h spreads
// its light by h^2/6, the cap that stands for it by h^2/(2 pi). w and d: unit.
[[nodiscard]] double texel_spread(const glm::dvec3& w, const glm::dvec3& d, double solid_angle);

}  // namespace shoal
