#include "scenes/pictures.h"

#include <cmath>

#include "scenes/colours.h"

namespace shoal::viz {

Picture tone_mapped_picture(const Pixels& pixels, double exposure) {
  Picture picture{{pixels.width, pixels.height}, {}};
  picture.rgb.reserve(pixels.rgb.size());
  for (std::size_t i = 0; i + 2 < pixels.rgb.size(); i += 3) {
    const glm::vec3 colour =
        tone_mapped({pixels.rgb[i], pixels.rgb[i + 1], pixels.rgb[i + 2]}, exposure);
    for (int c = 0; c < 3; ++c) {
      picture.rgb.push_back(static_cast<unsigned char>(std::lround(255.0f * colour[c])));
    }
  }
  return picture;
}

}  // namespace shoal::viz
