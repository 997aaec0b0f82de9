// Rotations as people tell them, as matrices of the native frame for sphere/rotation.h.
//
// Angles are in degrees of arc here. Quarter turns about an axis of the picture or of a frame give
// exact signed permutations. Matrices are orthogonal to 1e-15.
#pragma once

#include <glm/gtc/quaternion.hpp>
#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>
#include <vector>

#include "core/result.h"
#include "sphere/frame.h"

namespace shoal {

// A turn of the panorama as seen in its equirect picture, whatever the frame: applied in the order
// roll, pitch, yaw.
//   roll   clockwise about the picture's centre: what was above it moves to its right
//   pitch  what was at the centre moves up
//   yaw    the whole picture moves to the right, columns leaving on the right coming in on the left
// So a sun at the picture's centre is brought to elevation `pitch`, and then `yaw` to the right.
struct PictureTurn {
  double yaw = 0.0;
  double pitch = 0.0;
  double roll = 0.0;

  friend bool operator==(const PictureTurn&, const PictureTurn&) = default;
};

// Error: usage, for an angle that is not finite.
[[nodiscard]] Result<glm::dmat3> turn_matrix(const PictureTurn& turn);

// The turn by `angle` about `axis`, by the right-hand formula in the frame's coordinates:
//   x' = cos(angle) x + sin(angle) (a cross x) + (1 - cos(angle)) (a . x) a,
// with the cross product's components as they are always written. The axis need not be of unit
// length. Errors: usage, for an axis that is zero or not finite, or such an angle.
[[nodiscard]] Result<glm::dmat3> axis_turn(const glm::dvec3& axis, double angle,
                                           const Frame& frame);

// The turn of a quaternion (w, x, y, z), in the frame's coordinates and by GLM's formula, which is
// the one above with w = cos(angle/2), (x, y, z) = sin(angle/2) a. It need not be of unit length.
// Error: usage, for one that is zero or not finite.
[[nodiscard]] Result<glm::dmat3> quaternion_turn(const glm::dquat& quaternion, const Frame& frame);

// `count` yaw turns spread evenly about the vertical, by 360 k/count; the first leaves the panorama
// as it is. Precondition: count >= 1.
[[nodiscard]] std::vector<glm::dmat3> spread_turns(int count);

// `count` rotations spread evenly over all rotations: super-Fibonacci spirals (Alexa,
// "Super-Fibonacci Spirals: Fast, Low-Discrepancy Sampling of SO(3)", CVPR 2022, algorithm 1), all
// turned back by the first, which so leaves the panorama as it is and spoils no evenness. A larger
// set does not contain a smaller one. Precondition: count >= 1.
[[nodiscard]] std::vector<glm::dmat3> spread_all(int count);

}  // namespace shoal
