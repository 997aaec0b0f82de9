// A ball as a flat picture, for where there are hundreds of them.
#pragma once

#include "scenes/colours.h"
#include "sphere/coefficients.h"
#include "sphere/frame.h"
#include "window/picture.h"

namespace shoal::viz {

// The function, of native coefficients, on a ball that is drawn in `frame` and seen from far away,
// from viewer_direction: what add_ball shows. side x side pixels, around it `ground`.
// Precondition: side >= 4.
[[nodiscard]] Picture ball_picture(const Coefficients& native, const Frame& frame, double exposure,
                                   int side, const glm::vec3& ground);

}  // namespace shoal::viz
