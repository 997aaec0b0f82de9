// What a change of light does to pixels.
#pragma once

#include <glm/mat3x3.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "library/pixels.h"

namespace shoal::viz {

// Where an equirect picture shows a native direction: fractions of its width and its height, from
// its upper left corner. The direction is of unit length.
[[nodiscard]] glm::dvec2 place_of(const glm::dvec3& native);

// matrix * (r, g, b) at every texel.
void apply_colour(const glm::dmat3& matrix, Pixels& pixels);

// The picture of the scene turned: what it showed at x it shows at turn * x. A texel is the mean of
// nine places in it, so light of a single texel is kept to a tenth or so: to be looked at, not to
// be integrated.
[[nodiscard]] Pixels turned(const Pixels& pixels, const glm::dmat3& turn);

}  // namespace shoal::viz
