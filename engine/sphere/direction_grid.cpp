#include "sphere/direction_grid.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>
#include <numeric>

#include "sphere/basis.h"
#include "sphere/equirect_evaluator.h"
#include "sphere/gauss_legendre.h"

namespace shoal {
namespace {

// long double's functions are the same on every x86-64; double's depend on whether the CPU fuses.
using Real = long double;
constexpr Real kPi = std::numbers::pi_v<Real>;

struct Angle {
  double cosine = 1.0;
  double sine = 0.0;
};

Angle column_angle(int column, int columns) {
  const Real angle = kPi * (2 * column + 1) / columns;
  return {static_cast<double>(std::cos(angle)), static_cast<double>(std::sin(angle))};
}

Angle row_angle(int row, int rows) {
  const Real angle = kPi * (2 * row + 1) / (2 * rows);
  return {static_cast<double>(std::cos(angle)), static_cast<double>(std::sin(angle))};
}

}  // namespace

DirectionGrid gauss_grid(int rows) {
  const GaussRule rule = gauss_legendre(rows);
  const int columns = 2 * rows;
  DirectionGrid grid;
  for (int i = rows - 1; i >= 0; --i) {
    const Real z = rule.nodes[i];
    const Real sine = std::sqrt((1 - z) * (1 + z));
    for (int j = 0; j < columns; ++j) {
      const Angle phi = column_angle(j, columns);
      grid.directions.emplace_back(static_cast<double>(sine * phi.cosine),
                                   static_cast<double>(sine * phi.sine), static_cast<double>(z));
      grid.weights.push_back(static_cast<double>(rule.weights[i] * 2 * kPi / columns));
    }
  }
  return grid;
}

glm::dvec3 EquirectValues::direction(std::size_t index) const {
  const Angle theta = row_angle(static_cast<int>(index / columns()), rows);
  const Angle phi = column_angle(static_cast<int>(index % columns()), columns());
  return {theta.sine * phi.cosine, theta.sine * phi.sine, theta.cosine};
}

DirectedValue extremum_of(std::span<const double> coefficients, int degree,
                          const EquirectValues& grid, Extremum which) {
  const double sign = which == Extremum::least ? -1.0 : 1.0;
  const Basis<double> basis(degree);
  std::vector<double> y(coefficient_count(degree));
  const auto height_at = [&](const glm::dvec3& direction) {
    basis.evaluate(direction, y);
    return sign * std::inner_product(y.begin(), y.end(), coefficients.begin(), 0.0);
  };
  const auto [low, high] = std::ranges::minmax_element(grid.values);
  const auto texel = (which == Extremum::least ? low : high) - grid.values.begin();
  glm::dvec3 direction = grid.direction(static_cast<std::size_t>(texel));
  double height = height_at(direction);
  constexpr double kFinest = 1e-9;
  for (double step = std::numbers::pi / grid.rows; step > kFinest;) {
    const glm::dvec3 off = std::abs(direction.z) < 0.7 ? glm::dvec3(0, 0, 1) : glm::dvec3(1, 0, 0);
    const glm::dvec3 u = glm::normalize(glm::cross(off, direction));
    const glm::dvec3 v = glm::cross(direction, u);
    bool climbed = false;
    for (const glm::dvec3& way : {u, -u, v, -v}) {
      const glm::dvec3 next = glm::normalize(direction + step * way);
      const double next_height = height_at(next);
      if (next_height <= height) continue;
      direction = next;
      height = next_height;
      climbed = true;
      break;
    }
    if (!climbed) step /= 2;
  }
  return {sign * height, direction};
}

EquirectValues equirect_values(std::span<const double> coefficients, int degree, int rows) {
  EquirectValues grid;
  grid.rows = rows;
  const std::size_t columns = grid.columns();
  grid.values.resize(rows * columns);
  const EquirectEvaluator evaluator(degree, grid.columns(), rows);
  for (int i = 0; i < rows; ++i) {
    grid.shares.push_back(evaluator.share(i));
    evaluator.evaluate(coefficients, i, std::span(grid.values).subspan(i * columns, columns));
  }
  return grid;
}

}  // namespace shoal
