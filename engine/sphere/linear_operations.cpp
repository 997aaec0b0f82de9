#include "sphere/linear_operations.h"

#include <cmath>

namespace shoal {
namespace {

// ITU-R BT.709-6, item 3.2: luminance of linear R, G, B.
constexpr glm::dvec3 kLuminance(0.2126, 0.7152, 0.0722);

bool all_finite(const glm::dmat3& matrix) {
  for (int column = 0; column < 3; ++column) {
    for (int row = 0; row < 3; ++row) {
      if (!std::isfinite(matrix[column][row])) return false;
    }
  }
  return true;
}

bool is_diagonal(const glm::dmat3& matrix) {
  for (int column = 0; column < 3; ++column) {
    for (int row = 0; row < 3; ++row) {
      if (row != column && matrix[column][row] != 0.0) return false;
    }
  }
  return true;
}

}  // namespace

double luminance(const glm::dvec3& rgb) {
  return kLuminance.x * rgb.x + kLuminance.y * rgb.y + kLuminance.z * rgb.z;
}

double luminance(const Coefficients& coefficients, int i) {
  return luminance(glm::dvec3(coefficients.channels[0][i], coefficients.channels[1][i],
                              coefficients.channels[2][i]));
}

Result<glm::dmat3> combined_matrix(const ColourOperations& operations) {
  glm::dmat3 combined = operations.matrix;
  if (operations.white) {
    const glm::dvec3 white = *operations.white;
    const double grey = luminance(white);
    for (int c = 0; c < 3; ++c) {
      if (!(white[c] > 0.0) || !std::isfinite(white[c])) {
        return Error{ErrorCode::usage, "the white's components are not all positive and finite", "",
                     "give the linear Rec.709 colour that shall become grey"};
      }
      combined[c] *= grey / white[c];
    }
  }
  // long double's exp2 is the same on every x86-64; double's depends on whether the CPU fuses.
  const double factor = static_cast<double>(
      operations.scale * std::exp2(static_cast<long double>(operations.exposure_stops)));
  combined *= factor;
  if (!all_finite(combined)) {
    return Error{ErrorCode::usage, "exposure, scale and colour matrix together are not finite", "",
                 "check their values"};
  }
  return combined;
}

Coefficients apply_matrix(Coefficients coefficients, const glm::dmat3& matrix) {
  if (matrix == glm::dmat3(1.0)) return coefficients;
  if (is_diagonal(matrix)) {
    for (int c = 0; c < kChannelCount; ++c) {
      for (double& value : coefficients.channels[c]) value *= matrix[c][c];
    }
    return coefficients;
  }
  auto& [red, green, blue] = coefficients.channels;
  for (std::size_t i = 0; i < red.size(); ++i) {
    const glm::dvec3 rgb = matrix * glm::dvec3(red[i], green[i], blue[i]);
    red[i] = rgb.x;
    green[i] = rgb.y;
    blue[i] = rgb.z;
  }
  return coefficients;
}

Coefficients add(Coefficients a, const Coefficients& b) {
  for (int c = 0; c < kChannelCount; ++c) {
    for (std::size_t i = 0; i < a.channels[c].size(); ++i) a.channels[c][i] += b.channels[c][i];
  }
  return a;
}

Coefficients truncate(Coefficients coefficients, int degree) {
  if (degree >= coefficients.degree) return coefficients;
  coefficients.degree = degree;
  for (auto& channel : coefficients.channels) channel.resize(coefficient_count(degree));
  return coefficients;
}

}  // namespace shoal
