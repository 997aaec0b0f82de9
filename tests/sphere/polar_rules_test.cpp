#include "sphere/polar_rules.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <numbers>

namespace shoal {
namespace {

constexpr long double kPi = std::numbers::pi_v<long double>;

struct Rule {
  std::vector<long double> angles, weights;  // all rows
};

Rule unfolded(int height, const std::vector<long double>& northern,
              const std::function<long double(int)>& angle) {
  Rule rule;
  for (int i = 0; i < height; ++i) {
    rule.angles.push_back(angle(i));
    rule.weights.push_back(northern[std::min(i, height - 1 - i)]);
  }
  return rule;
}

Rule fejer(int height) {
  return unfolded(height, fejer_weights(height), [=](int i) { return kPi * (i + 0.5L) / height; });
}

Rule clenshaw_curtis(int height) {
  return unfolded(height, clenshaw_curtis_weights(height),
                  [=](int i) { return kPi * i / (height - 1); });
}

// The integral of cos(k t) sin(t) over [0, pi], that is of the Chebyshev polynomial T_k over [-1,
// 1], is 2/(1-k^2) for even k, else 0.
long double moment_error(const Rule& rule, int k) {
  long double sum = 0;
  for (std::size_t i = 0; i < rule.angles.size(); ++i) {
    sum += rule.weights[i] * std::cos(k * rule.angles[i]);
  }
  return sum - (k % 2 == 0 ? 2.0L / (1 - static_cast<long double>(k) * k) : 0.0L);
}

// Waldvogel 2006, eq. 2.2.
TEST(PolarRules, FejerIsTheCosineSum) {
  for (int n : {1, 2, 3, 4, 5, 16, 37, 300, 1001}) {
    const Rule rule = fejer(n);
    for (int i = 0; i < n; ++i) {
      long double sum = 1;
      for (int k = 1; k <= n / 2; ++k) {
        sum -= 2 * std::cos(2 * k * rule.angles[i]) / (4.0L * k * k - 1);
      }
      // Of the mean weight 2/n; the angle 2 k theta of the sum is itself good to n roundings.
      EXPECT_NEAR(static_cast<double>(rule.weights[i] * n - 2 * sum), 0.0, 1e-15) << n << ' ' << i;
    }
  }
}

// Waldvogel 2006, eq. 2.4.
TEST(PolarRules, ClenshawCurtisIsTheCosineSum) {
  for (int height : {2, 3, 4, 5, 6, 17, 38, 301, 1002}) {
    const Rule rule = clenshaw_curtis(height);
    const int n = height - 1;
    for (int i = 0; i < height; ++i) {
      long double sum = 1;
      for (int k = 1; k <= n / 2; ++k) {
        sum -= (2 * k == n ? 1 : 2) * std::cos(2 * k * rule.angles[i]) / (4.0L * k * k - 1);
      }
      const long double expected = (i == 0 || i == n ? 1 : 2) * sum;
      EXPECT_NEAR(static_cast<double>(rule.weights[i] * n - expected), 0.0, 1e-15)
          << height << ' ' << i;
    }
  }
}

// Small cases by hand: one row is the midpoint rule, two endpoints the trapezoid's, three
// Simpson's.
TEST(PolarRules, SmallestAreTheTextbooks) {
  EXPECT_NEAR(static_cast<double>(fejer_weights(1)[0]), 2.0, 1e-18);
  EXPECT_NEAR(static_cast<double>(fejer_weights(2)[0]), 1.0, 1e-18);
  EXPECT_NEAR(static_cast<double>(clenshaw_curtis_weights(2)[0]), 1.0, 1e-18);
  EXPECT_NEAR(static_cast<double>(clenshaw_curtis_weights(3)[0]), 1.0 / 3, 1e-18);
  EXPECT_NEAR(static_cast<double>(clenshaw_curtis_weights(3)[1]), 4.0 / 3, 1e-18);
}

// Exact to T_(H-1); T_H comes free for odd H, being odd. The next even one is wrong: on the nodes
// of Fejer T_H = 0, so that for even H its sum misses the whole 2/(1-H^2); for odd H, T_(H+1) =
// -T_(H-1) there. On those of Clenshaw-Curtis T_(N+1) = T_(N-1) and T_(N+2) = T_(N-2), N = H-1,
// whose integrals differ by about 8/N^3 and 16/N^3.
TEST(PolarRules, ExactToTheirDegreeAndNoFurther) {
  for (int height : {2, 3, 8, 9, 64, 101}) {
    for (const Rule& rule : {fejer(height), clenshaw_curtis(height)}) {
      for (int k = 0; k < height; ++k) {
        EXPECT_NEAR(static_cast<double>(moment_error(rule, k)), 0.0, 1e-16) << height << ' ' << k;
      }
      const int beyond = height % 2 == 0 ? height : height + 1;
      EXPECT_NEAR(static_cast<double>(moment_error(rule, beyond - 1)), 0.0, 1e-16);
      EXPECT_GT(std::abs(static_cast<double>(moment_error(rule, beyond))),
                4.0 / std::pow(height, 3))
          << height;
    }
  }
}

TEST(PolarRules, ArePositiveAndSumToTwoAtEveryHeight) {
  std::vector<int> heights = {511, 512, 513, 1024, 4095, 8192, 16383, 16384};
  for (int h = 1; h <= 130; ++h) heights.push_back(h);
  for (int height : heights) {
    std::vector<Rule> rules = {fejer(height)};
    if (height > 1) rules.push_back(clenshaw_curtis(height));
    for (const Rule& rule : rules) {
      for (long double weight : rule.weights) EXPECT_GT(weight, 0.0L) << height;
      EXPECT_NEAR(static_cast<double>(moment_error(rule, 0)), 0.0, 1e-16) << height;
    }
  }
}

}  // namespace
}  // namespace shoal
