#include "library/viewpoint.h"

#include <glm/geometric.hpp>

namespace shoal::viz {

glm::dvec3 viewer_direction(const Frame& frame) {
  const glm::dvec3 side = direction_of({frame.right.axis, 1});
  return glm::normalize(direction_of(frame.center) + side + 0.5 * direction_of(frame.up));
}

}  // namespace shoal::viz
