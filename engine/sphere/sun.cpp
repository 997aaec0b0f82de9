#include "sphere/sun.h"

#include <cmath>
#include <numbers>

namespace shoal {

DiskLight Sun::disk() const {
  const double sine = std::sin(angular_radius);
  return {direction, angular_radius, irradiance / (std::numbers::pi * sine * sine)};
}

}  // namespace shoal
