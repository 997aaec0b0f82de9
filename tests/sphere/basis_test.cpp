#include "sphere/basis.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "sphere/gauss_legendre.h"
#include "sphere_samples.h"

namespace shoal {
namespace {

constexpr double kPi = std::numbers::pi;

std::vector<double> basis_at(int degree, const glm::dvec3& direction) {
  std::vector<double> values(coefficient_count(degree));
  Basis<double>(degree).evaluate(direction, values);
  return values;
}

// Ramamoorthi & Hanrahan 2001, eq. 3, with the exact constants.
TEST(Basis, IsTheirsToDegreeTwo) {
  const double k0 = std::sqrt(1 / kPi) / 2, k1 = std::sqrt(3 / kPi) / 2,
               k2 = std::sqrt(15 / kPi) / 2, k20 = std::sqrt(5 / kPi) / 4,
               k22 = std::sqrt(15 / kPi) / 4;
  for (const glm::dvec3& d : test::random_directions(200)) {
    const std::vector<double> y = basis_at(2, d);
    const double expected[] = {k0,
                               k1 * d.y,
                               k1 * d.z,
                               k1 * d.x,
                               k2 * d.x * d.y,
                               k2 * d.y * d.z,
                               k20 * (3 * d.z * d.z - 1),
                               k2 * d.x * d.z,
                               k22 * (d.x * d.x - d.y * d.y)};
    for (int i = 0; i < 9; ++i) EXPECT_NEAR(y[i], expected[i], 2e-15) << i;
  }
}

// sum over m of Y_lm(a) Y_lm(b) = (2l+1)/(4 pi) P_l(a.b).
TEST(Basis, AdditionTheorem) {
  const auto directions = test::random_directions(40);
  for (std::size_t k = 1; k < directions.size(); ++k) {
    const std::vector<double> a = basis_at(kMaxDegree, directions[k - 1]);
    const std::vector<double> b = basis_at(kMaxDegree, directions[k]);
    const long double x = glm::dot(directions[k - 1], directions[k]);
    long double previous = 0, current = 1;  // P_-1, P_0
    for (int l = 0; l <= kMaxDegree; ++l) {
      long double sum = 0;
      for (int m = -l; m <= l; ++m) {
        sum += static_cast<long double>(a[coefficient_index(l, m)]) * b[coefficient_index(l, m)];
      }
      const long double norm = (2 * l + 1) / (4 * std::numbers::pi_v<long double>);
      // The rounding of the dot product moves P_l by up to l(l+1)/2 of it, 1e-16.
      EXPECT_NEAR(static_cast<double>(sum / norm), static_cast<double>(current), 5e-13) << l;
      const long double next = ((2 * l + 1) * x * current - l * previous) / (l + 1);
      previous = current;
      current = next;
    }
  }
}

// On the grid of 65 Gauss-Legendre rows and 130 columns the sum is exact for products of degree
// 128, so synthesis followed by analysis is multiplication with the Gram matrix: the identity.
// Random coefficients see every entry of it.
TEST(Basis, GramMatrixIsTheIdentityAtDegree64) {
  constexpr int kColumns = 2 * kMaxDegree + 2;
  const GaussRule rule = gauss_legendre(kMaxDegree + 1);
  const Basis<double> basis(kMaxDegree);
  const Coefficients given = test::random_coefficients(kMaxDegree);
  Coefficients found(kMaxDegree);
  std::vector<double> y(coefficient_count(kMaxDegree));
  for (std::size_t i = 0; i < rule.nodes.size(); ++i) {
    const long double z = rule.nodes[i];
    const double s = static_cast<double>(std::sqrt(1 - z * z));
    const double weight = static_cast<double>(rule.weights[i]) * 2 * kPi / kColumns;
    for (int j = 0; j < kColumns; ++j) {
      const double phi = 2 * kPi * j / kColumns;
      basis.evaluate({s * std::cos(phi), s * std::sin(phi), static_cast<double>(z)}, y);
      const glm::dvec3 value = weight * evaluate(given, y);
      for (int c = 0; c < kChannelCount; ++c) {
        for (std::size_t k = 0; k < y.size(); ++k) found.channels[c][k] += value[c] * y[k];
      }
    }
  }
  // 4225 unit coefficients, each row of G - I with errors below 1e-13 of random sign.
  EXPECT_LT(test::largest_difference(given, found), 1e-12);
}

TEST(Basis, LongDoubleAgrees) {
  const Basis<long double> wide(kMaxDegree);
  std::vector<long double> exact(coefficient_count(kMaxDegree));
  for (const glm::dvec3& d : test::random_directions(100)) {
    const std::vector<double> y = basis_at(kMaxDegree, d);
    wide.evaluate(glm::vec<3, long double>(d), exact);
    for (std::size_t i = 0; i < y.size(); ++i) {
      // m roundings of the azimuth and those of the Legendre functions, on values up to 3.
      EXPECT_NEAR(y[i], static_cast<double>(exact[i]), 3e-13) << i;
    }
  }
}

TEST(Basis, PolesHaveZonalValuesOnly) {
  for (double z : {1.0, -1.0}) {
    const std::vector<double> y = basis_at(kMaxDegree, {0.0, 0.0, z});
    for (int l = 0; l <= kMaxDegree; ++l) {
      for (int m = -l; m <= l; ++m) {
        const double expected =
            m == 0 ? std::sqrt((2 * l + 1) / (4 * kPi)) * (z < 0 && l % 2 == 1 ? -1 : 1) : 0.0;
        EXPECT_NEAR(y[coefficient_index(l, m)], expected, 5e-13) << l << ' ' << m;
      }
    }
  }
}

// A single coefficient is its basis function, channels apart.
TEST(Basis, EvaluateSumsEachChannel) {
  Coefficients coefficients(3);
  coefficients.channels[0][coefficient_index(1, 1)] = 2.0;
  coefficients.channels[1][coefficient_index(3, -2)] = -1.0;
  coefficients.channels[2][0] = 0.5;
  for (const glm::dvec3& d : test::random_directions(20)) {
    const std::vector<double> y = basis_at(3, d);
    const glm::dvec3 value = evaluate(coefficients, d);
    EXPECT_EQ(value.x, 2.0 * y[coefficient_index(1, 1)]);
    EXPECT_EQ(value.y, -y[coefficient_index(3, -2)]);
    EXPECT_EQ(value.z, 0.5 * y[0]);
  }
}

}  // namespace
}  // namespace shoal
