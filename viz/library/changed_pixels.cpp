#include "library/changed_pixels.h"

#include <algorithm>
#include <cmath>
#include <glm/matrix.hpp>
#include <numbers>

namespace shoal::viz {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr int kPlaces = 3;  // a side of a texel

const float* texel_at(const Pixels& pixels, const glm::dvec3& native) {
  const glm::dvec2 place = place_of(native);
  return pixels.at(std::min(static_cast<int>(place.y * pixels.height), pixels.height - 1),
                   std::min(static_cast<int>(place.x * pixels.width), pixels.width - 1));
}

}  // namespace

glm::dvec2 place_of(const glm::dvec3& native) {
  const double turn = std::atan2(native.y, native.x) / (2.0 * kPi);
  return {turn - std::floor(turn), std::acos(std::clamp(native.z, -1.0, 1.0)) / kPi};
}

void apply_colour(const glm::dmat3& matrix, Pixels& pixels) {
  for (std::size_t i = 0; i + 2 < pixels.rgb.size(); i += 3) {
    float* rgb = pixels.rgb.data() + i;
    const glm::dvec3 changed = matrix * glm::dvec3(rgb[0], rgb[1], rgb[2]);
    for (int c = 0; c < 3; ++c) rgb[c] = static_cast<float>(changed[c]);
  }
}

Pixels turned(const Pixels& pixels, const glm::dmat3& turn) {
  const glm::dmat3 back = glm::transpose(turn);
  Pixels result{pixels.width, pixels.height, std::vector<float>(pixels.rgb.size(), 0.0F)};
  for (int i = 0; i < kPlaces * pixels.height; ++i) {
    const double theta = kPi * (i + 0.5) / (kPlaces * pixels.height);
    const glm::dvec3 down = std::cos(theta) * back[2];
    float* row = result.rgb.data() + std::size_t{3} * (i / kPlaces) * pixels.width;
    for (int j = 0; j < kPlaces * pixels.width; ++j) {
      const double phi = 2.0 * kPi * (j + 0.5) / (kPlaces * pixels.width);
      const glm::dvec3 across = std::cos(phi) * back[0] + std::sin(phi) * back[1];
      const float* rgb = texel_at(pixels, down + std::sin(theta) * across);
      for (int c = 0; c < 3; ++c) row[3 * (j / kPlaces) + c] += rgb[c] / (kPlaces * kPlaces);
    }
  }
  return result;
}

}  // namespace shoal::viz
