#include "scenes/ball_picture.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <vector>

#include "library/viewpoint.h"
#include "scenes/actors.h"
#include "sphere/basis.h"

namespace shoal::viz {
namespace {

// Columns: the screen's right, its up, and towards the viewer, in native coordinates.
glm::dmat3 screen_to_native(const Frame& frame) {
  const glm::dmat3 to_frame = native_to_frame(frame);
  const glm::dvec3 towards = viewer_direction(frame);
  const glm::dvec3 frame_up = to_frame * glm::dvec3(0.0, 0.0, 1.0);
  const glm::dvec3 right = glm::normalize(glm::cross(frame_up, towards));
  return glm::transpose(to_frame) * glm::dmat3(right, glm::cross(towards, right), towards);
}

}  // namespace

Picture ball_picture(const Coefficients& native, const Frame& frame, double exposure, int side,
                     const glm::vec3& ground) {
  const Basis<double> basis(native.degree);
  std::vector<double> values(coefficient_count(native.degree));
  const glm::dmat3 to_native = screen_to_native(frame);
  const double radius = 0.5 * side - 1.0;
  Picture picture{{side, side}, {}};
  picture.rgb.reserve(std::size_t{3} * side * side);
  for (int i = 0; i < side; ++i) {
    for (int j = 0; j < side; ++j) {
      const glm::dvec2 place((j + 0.5 - 0.5 * side) / radius, (0.5 * side - i - 0.5) / radius);
      const double distance = glm::length(place);
      // Outside the rim its colour counts: there the ball's edge fades, a pixel wide.
      const glm::dvec2 on_ball = distance > 1.0 ? place / distance : place;
      const double depth = std::sqrt(std::max(0.0, 1.0 - glm::dot(on_ball, on_ball)));
      basis.evaluate(glm::normalize(to_native * glm::dvec3(on_ball, depth)), values);
      const glm::vec3 colour = tone_mapped(evaluate(native, values), exposure);
      const auto cover = static_cast<float>(std::clamp((1.0 - distance) * radius + 0.5, 0.0, 1.0));
      const glm::vec3 mixed = cover * colour + (1.0f - cover) * ground;
      for (int c = 0; c < 3; ++c) {
        picture.rgb.push_back(static_cast<unsigned char>(std::lround(255.0f * mixed[c])));
      }
    }
  }
  return picture;
}

}  // namespace shoal::viz
