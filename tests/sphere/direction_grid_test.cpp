#include "sphere/direction_grid.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

#include "sphere/basis.h"

namespace shoal {
namespace {

// The Gram matrix of the basis is the identity wherever degrees sum to no more than 2 rows - 1, and
// visibly not one degree above: P_rows is zero at all nodes.
TEST(DirectionGrid, IntegratesProductsToTheStatedDegree) {
  constexpr int kRows = 6;
  const DirectionGrid grid = gauss_grid(kRows);
  ASSERT_EQ(grid.directions.size(), 2U * kRows * kRows);
  const Basis<double> basis(kRows);
  const int count = coefficient_count(kRows);
  std::vector<double> gram(static_cast<std::size_t>(count) * count, 0.0);
  std::vector<double> y(count);
  for (std::size_t k = 0; k < grid.directions.size(); ++k) {
    EXPECT_NEAR(glm::length(grid.directions[k]), 1.0, 1e-15);
    basis.evaluate(grid.directions[k], y);
    for (int i = 0; i < count; ++i) {
      for (int j = 0; j < count; ++j) gram[i * count + j] += grid.weights[k] * y[i] * y[j];
    }
  }
  const int exact = coefficient_count(kRows - 1);
  for (int i = 0; i < exact; ++i) {
    for (int j = 0; j < exact; ++j) EXPECT_NEAR(gram[i * count + j], i == j, 1e-13);
  }
  const int top = coefficient_index(kRows, 0);
  EXPECT_NEAR(gram[top * count + top], 0.0, 1e-13) << "it should be 1";
}

// Y_10 about an axis d is sqrt(3/(4 pi)) (d . x): greatest at d, least at -d, whatever the grid.
TEST(DirectionGrid, ExtremaAreClimbedTo) {
  const glm::dvec3 d(0.48, -0.6, 0.64);
  const double size = std::sqrt(3 / (4 * std::numbers::pi));
  // Y_1-1, Y_10, Y_11 are y, z, x times that factor.
  const std::vector<double> coefficients = {0.0, d.y, d.z, d.x};
  for (const int rows : {3, 8, 65}) {
    const EquirectValues grid = equirect_values(coefficients, 1, rows);
    const DirectedValue greatest = extremum_of(coefficients, 1, grid, Extremum::greatest);
    const DirectedValue least = extremum_of(coefficients, 1, grid, Extremum::least);
    EXPECT_NEAR(greatest.value, size, 1e-15);
    EXPECT_NEAR(least.value, -size, 1e-15);
    EXPECT_LT(glm::distance(greatest.direction, d), 1e-7);  // where doubles see no slope
    EXPECT_LT(glm::distance(least.direction, -d), 1e-7);
  }
}

TEST(DirectionGrid, EquirectValuesAreThoseOfTheBasis) {
  constexpr int kDegree = 9;
  const Basis<double> basis(kDegree);
  std::vector<double> y(coefficient_count(kDegree));
  std::vector<double> coefficients(y.size());
  for (std::size_t i = 0; i < y.size(); ++i) coefficients[i] = std::sin(7.0 * i + 1);
  const EquirectValues grid = equirect_values(coefficients, kDegree, 12);
  ASSERT_EQ(grid.values.size(), 12U * 24U);
  double whole = 0.0;
  for (std::size_t k = 0; k < grid.values.size(); ++k) {
    basis.evaluate(grid.direction(k), y);
    double sum = 0.0;
    for (std::size_t i = 0; i < y.size(); ++i) sum += coefficients[i] * y[i];
    EXPECT_NEAR(grid.values[k], sum, 1e-12);
    whole += grid.shares[k / grid.columns()];
  }
  EXPECT_NEAR(whole, 1.0, 1e-14);
  // The first texel of the top row: theta = pi/24, phi = pi/24.
  const double half = std::numbers::pi / 24;
  EXPECT_NEAR(grid.direction(0).z, std::cos(half), 1e-15);
  EXPECT_NEAR(grid.direction(0).y, std::sin(half) * std::sin(half), 1e-15);
}

}  // namespace
}  // namespace shoal
