#include "sphere/turns.h"

#include <algorithm>
#include <cmath>
#include <glm/matrix.hpp>
#include <numbers>
#include <utility>

namespace shoal {
namespace {

// long double's functions are the same on every x86-64; double's depend on whether the CPU fuses.
using Real = long double;
constexpr Real kPi = std::numbers::pi_v<Real>;

// Rounded to double once, at the end: products of rounded matrices stray from orthogonality, and
// sphere/rotation.h passes that on times the degree.
using Matrix = glm::mat<3, 3, Real>;
using Quaternion = glm::qua<Real>;

struct SineCosine {
  Real sine = 0;
  Real cosine = 1;
};

// Of an angle in degrees, exact at quarter turns: the remainder by 90 is exact.
SineCosine sine_cosine(double degrees) {
  int quarter = 0;
  const double rest = std::remquo(degrees, 90.0, &quarter);
  const Real angle = rest * (kPi / 180);
  SineCosine value{std::sin(angle), std::cos(angle)};
  for (int k = quarter & 3; k > 0; --k) value = {value.cosine, -value.sine};
  return value;
}

// Rodrigues' formula; columns are where the axes go. `axis` is of unit length.
Matrix rodrigues(const glm::vec<3, Real>& axis, const SineCosine& angle) {
  const Real versine = 1 - angle.cosine;
  Matrix matrix;
  for (int column = 0; column < 3; ++column) {
    for (int row = 0; row < 3; ++row) {
      Real value = versine * axis[row] * axis[column];
      if (row == column) {
        value += angle.cosine;
      } else {
        // The cross product: a x e_column has a_third, its sign by the order of the three.
        const int third = 3 - row - column;
        const bool cyclic = (column + 1) % 3 == row;
        value += cyclic ? angle.sine * axis[third] : -angle.sine * axis[third];
      }
      matrix[column][row] = value;
    }
  }
  return matrix;
}

Matrix about_native_axis(int axis, double degrees) {
  glm::vec<3, Real> direction(0);
  direction[axis] = 1;
  return rodrigues(direction, sine_cosine(degrees));
}

// The matrix that does in the native frame what `matrix` does in `frame`.
glm::dmat3 in_native(const Matrix& matrix, const Frame& frame) {
  const Matrix to(native_to_frame(frame));
  return glm::dmat3(glm::transpose(to) * matrix * to);
}

}  // namespace

// The picture's centre is -x, its right -y, its up +z (sphere/conventions.h). Yaw takes the centre
// to the right, about centre x right = +z; pitch takes the centre up, about centre x up = +y; roll
// takes up to the right, about up x right = +x.
Result<glm::dmat3> turn_matrix(const PictureTurn& turn) {
  if (!std::isfinite(turn.yaw) || !std::isfinite(turn.pitch) || !std::isfinite(turn.roll)) {
    return Error{ErrorCode::usage, "an angle of a rotation is not finite", "",
                 "give yaw, pitch and roll in degrees"};
  }
  return glm::dmat3(about_native_axis(2, turn.yaw) * about_native_axis(1, turn.pitch) *
                    about_native_axis(0, turn.roll));
}

Result<glm::dmat3> axis_turn(const glm::dvec3& axis, double angle, const Frame& frame) {
  const double largest = std::max({std::abs(axis.x), std::abs(axis.y), std::abs(axis.z)});
  const bool finite = std::isfinite(axis.x) && std::isfinite(axis.y) && std::isfinite(axis.z);
  if (!finite || largest == 0.0) {
    return Error{ErrorCode::usage, "the axis of a rotation is zero or not finite", "",
                 "give the vector to turn about, such as [0, 1, 0]"};
  }
  if (!std::isfinite(angle)) {
    return Error{ErrorCode::usage, "the angle of a rotation is not finite", "",
                 "give it in degrees"};
  }
  const glm::vec<3, Real> scaled = glm::vec<3, Real>(axis) / static_cast<Real>(largest);
  const Real length = std::sqrt(scaled.x * scaled.x + scaled.y * scaled.y + scaled.z * scaled.z);
  return in_native(rodrigues(scaled / length, sine_cosine(angle)), frame);
}

Result<glm::dmat3> quaternion_turn(const glm::dquat& quaternion, const Frame& frame) {
  const double largest = std::max({std::abs(quaternion.w), std::abs(quaternion.x),
                                   std::abs(quaternion.y), std::abs(quaternion.z)});
  const bool finite = std::isfinite(quaternion.w) && std::isfinite(quaternion.x) &&
                      std::isfinite(quaternion.y) && std::isfinite(quaternion.z);
  if (!finite || largest == 0.0) {
    return Error{ErrorCode::usage, "the quaternion of a rotation is zero or not finite", "",
                 "give (w, x, y, z) = (cos(angle/2), sin(angle/2) axis)"};
  }
  return in_native(glm::mat3_cast(glm::normalize(Quaternion(quaternion) / Real(largest))), frame);
}

std::vector<glm::dmat3> spread_turns(int count) {
  std::vector<glm::dmat3> turns;
  for (int k = 0; k < count; ++k) turns.emplace_back(about_native_axis(2, 360.0 * k / count));
  return turns;
}

std::vector<glm::dmat3> spread_all(int count) {
  const Real phi = std::numbers::sqrt2_v<Real>;
  const Real psi = 1.533751168755204288118041L;  // the real root above 1 of psi^4 = psi + 4
  std::vector<Matrix> spirals;
  for (int k = 0; k < count; ++k) {
    const Real s = k + 0.5L;
    const Real inner = std::sqrt(s / count);
    const Real outer = std::sqrt(1 - s / count);
    const Real alpha = 2 * kPi * s / phi;
    const Real beta = 2 * kPi * s / psi;
    spirals.push_back(glm::mat3_cast(Quaternion(outer * std::cos(beta), inner * std::sin(alpha),
                                                inner * std::cos(alpha), outer * std::sin(beta))));
  }
  const Matrix back = glm::transpose(spirals.front());
  std::vector<glm::dmat3> rotations;
  for (const Matrix& spiral : spirals) rotations.emplace_back(spiral * back);
  rotations.front() = glm::dmat3(1.0);
  return rotations;
}

}  // namespace shoal
