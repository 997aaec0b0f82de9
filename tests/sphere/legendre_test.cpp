#include "sphere/legendre.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "sphere/conventions.h"
#include "sphere/gauss_legendre.h"

namespace shoal {
namespace {

constexpr long double kPi = std::numbers::pi_v<long double>;

std::vector<double> pbar_at(int degree, double theta) {
  std::vector<double> values(legendre_count(degree));
  AssociatedLegendre<double>(degree).evaluate(std::cos(theta), std::sin(theta), values);
  return values;
}

// Pbar_lm = sqrt((2 - delta_m0) (2l+1)/(4 pi) (l-m)!/(l+m)!) P_lm, P_lm = sin^m d^m P_l/dx^m, from
// Rodrigues' formula for the few lowest.
TEST(Legendre, ClosedFormsToDegreeThree) {
  const double pi = std::numbers::pi;
  for (double theta : {0.0, 0.3, 1.0, pi / 2, 2.4, 3.1}) {
    const double c = std::cos(theta), s = std::sin(theta);
    const std::vector<double> p = pbar_at(3, theta);
    const double expected[] = {
        std::sqrt(1 / (4 * pi)),
        std::sqrt(3 / (4 * pi)) * c,
        std::sqrt(3 / (4 * pi)) * s,
        std::sqrt(5 / (16 * pi)) * (3 * c * c - 1),
        std::sqrt(15 / (4 * pi)) * c * s,
        std::sqrt(15 / (16 * pi)) * s * s,
        std::sqrt(7 / (16 * pi)) * (5 * c * c * c - 3 * c),
        std::sqrt(21 / (32 * pi)) * (5 * c * c - 1) * s,
        std::sqrt(105 / (16 * pi)) * c * s * s,
        std::sqrt(35 / (32 * pi)) * s * s * s,
    };
    for (int i = 0; i < 10; ++i) EXPECT_NEAR(p[i], expected[i], 1e-15) << i << " at " << theta;
  }
}

// 2 pi (pi for m != 0, whose sqrt(2) the square carries) times the integral of Pbar_lm Pbar_l'm
// over cos(theta) is 1 or 0. Gauss-Legendre of 65 nodes is exact for the product, of degree <= 128.
template <typename Real>
double worst_gram_error(int degree) {
  const GaussRule rule = gauss_legendre(degree + 1);
  const AssociatedLegendre<Real> legendre(degree);
  std::vector<std::vector<Real>> values;
  for (long double x : rule.nodes) {
    values.emplace_back(legendre_count(degree));
    legendre.evaluate(static_cast<Real>(x), static_cast<Real>(std::sqrt(1 - x * x)), values.back());
  }
  double worst = 0.0;
  for (int m = 0; m <= degree; ++m) {
    for (int l = m; l <= degree; ++l) {
      for (int k = m; k <= l; ++k) {
        long double sum = 0;
        for (std::size_t i = 0; i < values.size(); ++i) {
          sum +=
              rule.weights[i] * values[i][legendre_index(l, m)] * values[i][legendre_index(k, m)];
        }
        sum *= m == 0 ? 2 * kPi : kPi;
        worst = std::max(worst, static_cast<double>(std::abs(sum - (l == k ? 1 : 0))));
      }
    }
  }
  return worst;
}

TEST(Legendre, IsOrthonormalToDegree64) {
  // Values of size l^(1/2) with errors of 1e-13 of the largest, weighted to the sphere's middle.
  EXPECT_LT(worst_gram_error<double>(kMaxDegree), 1e-13);
  EXPECT_LT(worst_gram_error<long double>(kMaxDegree), 1e-16);
}

TEST(Legendre, DoubleAgreesWithLongDouble) {
  const int count = legendre_count(kMaxDegree);
  const AssociatedLegendre<double> narrow(kMaxDegree);
  const AssociatedLegendre<long double> wide(kMaxDegree);
  std::vector<double> error(count), largest(count), a(count);
  std::vector<long double> b(count);
  for (int i = 0; i <= 2000; ++i) {
    const long double theta = kPi * i / 2000;
    narrow.evaluate(static_cast<double>(std::cos(theta)), static_cast<double>(std::sin(theta)), a);
    wide.evaluate(std::cos(theta), std::sin(theta), b);
    for (int k = 0; k < count; ++k) {
      error[k] = std::max(error[k], static_cast<double>(std::abs(a[k] - b[k])));
      largest[k] = std::max(largest[k], static_cast<double>(std::abs(b[k])));
    }
  }
  // dP_l0/dcos(theta) = l(l+1)/2 at the pole: the cosine's own rounding, 5.6e-17, is worth 1.2e-13.
  for (int k = 0; k < count; ++k) EXPECT_LE(error[k], 3e-13 * largest[k]) << k;
}

// At the north pole Pbar_l0 = sqrt((2l+1)/(4 pi)) and everything of m != 0 vanishes; at the south
// pole the sign alternates.
TEST(Legendre, PolesHaveTheirExactValues) {
  const AssociatedLegendre<double> legendre(kMaxDegree);
  std::vector<double> north(legendre_count(kMaxDegree)), south(north);
  legendre.evaluate(1.0, 0.0, north);
  legendre.evaluate(-1.0, 0.0, south);
  for (int l = 0; l <= kMaxDegree; ++l) {
    const double value = std::sqrt((2 * l + 1) / (4 * std::numbers::pi));
    EXPECT_NEAR(north[legendre_index(l, 0)], value, 2e-13 * value);
    EXPECT_EQ(south[legendre_index(l, 0)],
              l % 2 == 0 ? north[legendre_index(l, 0)] : -north[legendre_index(l, 0)]);
    for (int m = 1; m <= l; ++m) {
      EXPECT_EQ(north[legendre_index(l, m)], 0.0);
      EXPECT_EQ(south[legendre_index(l, m)], 0.0);
    }
  }
}

// Next to the pole Pbar_lm = N_lm theta^m (l+m)!/(2^m m! (l-m)!) (1 + O(l^2 theta^2)), N_lm the
// factor above. Where theta^m is below the range of double the value is zero, never a subnormal's
// noise.
TEST(Legendre, NextToThePoleIsRightOrZero) {
  const long double theta = 1e-7L;
  std::vector<double> p(legendre_count(kMaxDegree));
  AssociatedLegendre<double>(kMaxDegree)
      .evaluate(static_cast<double>(std::cos(theta)), static_cast<double>(std::sin(theta)), p);
  int zeros = 0;
  for (int l = 0; l <= kMaxDegree; ++l) {
    for (int m = 0; m <= l; ++m) {
      const long double log_norm = 0.5L * (std::log((m == 0 ? 1 : 2) * (2 * l + 1) / (4 * kPi)) +
                                           std::lgamma(l - m + 1.0L) - std::lgamma(l + m + 1.0L));
      const long double log_value = log_norm + m * std::log(theta / 2) + std::lgamma(l + m + 1.0L) -
                                    std::lgamma(m + 1.0L) - std::lgamma(l - m + 1.0L);
      const double value = p[legendre_index(l, m)];
      if (value == 0.0) {
        ++zeros;
        EXPECT_LT(log_value, std::log(std::numeric_limits<double>::min()) + 100) << l << ' ' << m;
      } else {
        EXPECT_GE(value, std::numeric_limits<double>::min());
        EXPECT_NEAR(static_cast<double>(value / std::exp(log_value)), 1.0, 1e-10) << l << ' ' << m;
      }
    }
  }
  EXPECT_GT(zeros, 0);
  EXPECT_LT(zeros, 600);  // sin^m underflows from m = 44 on: 231 functions
}

TEST(Legendre, IsPositiveNextToTheNorthPole) {
  for (double value : pbar_at(kMaxDegree, 1e-4)) EXPECT_GE(value, 0.0);
}

// A mirrored row differs by the exact sign (-1)^(l+m): every step only flips signs.
TEST(Legendre, MirrorsExactly) {
  const AssociatedLegendre<double> legendre(kMaxDegree);
  std::vector<double> north(legendre_count(kMaxDegree)), south(north);
  legendre.evaluate(0.6, 0.8, north);
  legendre.evaluate(-0.6, 0.8, south);
  for (int l = 0; l <= kMaxDegree; ++l) {
    for (int m = 0; m <= l; ++m) {
      const double sign = (l + m) % 2 == 0 ? 1.0 : -1.0;
      EXPECT_EQ(south[legendre_index(l, m)], sign * north[legendre_index(l, m)]);
    }
  }
}

}  // namespace
}  // namespace shoal
