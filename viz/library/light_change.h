// What is done to the light of a panorama's pixels, but for a window over the degrees, which
// leaves the light what it is.
#pragma once

#include <glm/mat3x3.hpp>

namespace shoal::viz {

struct LightChange {
  glm::dmat3 colour{1.0};  // new (r, g, b) = colour * (r, g, b), linear Rec.709
  glm::dmat3 turn{1.0};    // what stood at x stands at turn * x, native frame
  bool is_whole = true;    // that is all; else lights were added or a part was taken out, too, or
                           // nobody says

  friend bool operator==(const LightChange&, const LightChange&) = default;
};

}  // namespace shoal::viz
