#include "sphere/sun.h"

#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

namespace shoal {

DiskLight Sun::disk() const {
  // 2 pi (1 - cos a), by the half angle so that small ones lose nothing.
  const double sine = std::sin(0.5 * angular_radius);
  return {direction, angular_radius, flux / (4.0 * std::numbers::pi * sine * sine)};
}

double disk_radius(double spread) { return 2.0 * std::asin(std::sqrt(0.5 * spread)); }

double texel_spread(const glm::dvec3& w, const glm::dvec3& d, double solid_angle) {
  const glm::dvec3 apart = w - d;
  return glm::dot(apart, apart) + glm::dot(w, d) * solid_angle / (2.0 * std::numbers::pi);
}

}  // namespace shoal
