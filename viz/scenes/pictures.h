// Light as pictures.
#pragma once

#include "library/pixels.h"
#include "window/picture.h"

namespace shoal::viz {

// tone_mapped of every texel. Precondition: the pixels are not empty.
[[nodiscard]] Picture tone_mapped_picture(const Pixels& pixels, double exposure);

}  // namespace shoal::viz
