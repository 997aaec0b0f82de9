#include "sphere/negative_share.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>

#include "sphere/direction_grid.h"

namespace shoal {
namespace {

constexpr int kLeastRows = 256;
constexpr int kMostRows = 512;
constexpr int kRowsPerDegree = 20;

// The part of a segment where what is linear between its ends is below zero.
double negative_part(double a, double b) {
  if ((a < 0.0) == (b < 0.0)) return a < 0.0 ? 1.0 : 0.0;
  return std::min(a, b) / (std::min(a, b) - std::max(a, b));
}

// The same of a triangle.
double negative_part(double a, double b, double c) {
  std::array<double, 3> values = {a, b, c};
  std::ranges::sort(values);
  const auto [low, middle, high] = values;
  if (low >= 0.0) return 0.0;
  if (high < 0.0) return 1.0;
  if (middle >= 0.0) return low / (low - middle) * (low / (low - high));
  return 1.0 - high / (high - middle) * (high / (high - low));
}

}  // namespace

double negative_share(std::span<const double> coefficients, int degree) {
  const int rows = std::clamp(kRowsPerDegree * (degree + 1), kLeastRows, kMostRows);
  const EquirectValues grid = equirect_values(coefficients, degree, rows);
  const auto columns = static_cast<std::size_t>(grid.columns());
  const double step = std::numbers::pi / rows;
  double share = 0.0;
  // Between the centres of two rows.
  for (int row = 0; row + 1 < rows; ++row) {
    const double* above = grid.values.data() + row * columns;
    const double* below = above + columns;
    double parts = 0.0;
    for (std::size_t j = 0; j < columns; ++j) {
      const std::size_t next = j + 1 < columns ? j + 1 : 0;
      parts += negative_part(above[j], above[next], below[next]);
      parts += negative_part(above[j], below[j], below[next]);
    }
    // cos(a) - cos(b) of the zone, half of which is its share.
    share += parts / (2.0 * columns) * std::sin(step * (row + 1)) * std::sin(step / 2.0);
  }
  // Within the first row and within the last.
  const double half_sine = std::sin(step / 4.0);
  for (const int row : {0, rows - 1}) {
    const double* values = grid.values.data() + row * columns;
    double parts = 0.0;
    for (std::size_t j = 0; j < columns; ++j) {
      parts += negative_part(values[j], values[j + 1 < columns ? j + 1 : 0]);
    }
    share += parts / columns * half_sine * half_sine;
  }
  return std::min(share, 1.0);
}

}  // namespace shoal
