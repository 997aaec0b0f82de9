// How a panorama's light is made of that of its pixels.
//
// The store keeps what the pixels were projected to, and the table what the manifest made of it:
// colours by a matrix, a rotation, a window. Both are exact on coefficients, so what was done is
// found from the two, and what is found explains every coefficient or is not taken.
#pragma once

#include <glm/mat3x3.hpp>
#include <optional>

#include "sphere/coefficients.h"

namespace shoal::viz {

struct LightChange {
  glm::dmat3 colour{1.0};  // new (r, g, b) = colour * (r, g, b), linear Rec.709
  glm::dmat3 turn{1.0};    // what stood at x stands at turn * x, native frame

  friend bool operator==(const LightChange&, const LightChange&) = default;
};

// The change that makes `told` of `own`, to a billionth of the light, but for a window over the
// degrees, which leaves the light what it is. Both are of one quantity, in the native frame.
// Found are a factor a channel with any rotation that the colours of degree 1 or the vertical
// tell, and any matrix of the colours without a rotation; nothing where lights were added, a part
// was taken out, or there is degree 0 alone.
[[nodiscard]] std::optional<LightChange> find_light_change(const Coefficients& own,
                                                           const Coefficients& told);

}  // namespace shoal::viz
