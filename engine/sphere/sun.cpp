#include "sphere/sun.h"

namespace shoal {

DiskLight Sun::disk() const { return {direction, angular_radius, mean_radiance()}; }

}  // namespace shoal
