// From where shapes in a frame are first seen: the same in all scenes and reports.
#pragma once

#include <glm/vec3.hpp>

#include "sphere/frame.h"

namespace shoal::viz {

// Towards the viewer, in the frame's axes, of unit length. Half way between the panorama's centre
// and the side on which a horizontal axis comes towards the viewer, and a little above: what
// shines from the centre lights what one sees, and its lobe is seen from its side, not end-on.
[[nodiscard]] glm::dvec3 viewer_direction(const Frame& frame);

}  // namespace shoal::viz
