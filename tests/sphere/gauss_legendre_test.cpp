#include "sphere/gauss_legendre.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace shoal {
namespace {

// The integral of x^k over [-1, 1] is 2/(k+1) for even k, else 0; n nodes give it for k <= 2n-1.
TEST(GaussLegendre, MomentsAreExactToTheTwiceNMinusFirst) {
  for (int n : {1, 2, 3, 4, 5, 8, 13, 32, 65, 128}) {
    const GaussRule rule = gauss_legendre(n);
    for (int k = 0; k <= 2 * n - 1; ++k) {
      long double sum = 0;
      for (int i = 0; i < n; ++i) sum += rule.weights[i] * std::pow(rule.nodes[i], k);
      const long double exact = k % 2 == 0 ? 2.0L / (k + 1) : 0.0L;
      // n roundings of long double, 5e-20 each.
      EXPECT_NEAR(static_cast<double>(sum - exact), 0.0, 1e-17) << "n " << n << " k " << k;
    }
  }
}

// One degree higher the rule fails by 2^(2n+1) (n!)^4 / ((2n+1) (2n)!^2), the square norm of the
// monic Legendre polynomial: for n = 2 that is 8/45.
TEST(GaussLegendre, TheTwiceNthMomentIsMissedByTheKnownAmount) {
  const GaussRule rule = gauss_legendre(2);
  long double sum = 0;
  for (int i = 0; i < 2; ++i) sum += rule.weights[i] * std::pow(rule.nodes[i], 4);
  EXPECT_NEAR(static_cast<double>(2.0L / 5 - sum), 8.0 / 45, 1e-16);
}

TEST(GaussLegendre, IsMirroredExactly) {
  for (int n : {1, 2, 7, 64}) {
    const GaussRule rule = gauss_legendre(n);
    for (int k = 0; k < n; ++k) {
      EXPECT_EQ(rule.nodes[k], -rule.nodes[n - 1 - k]);
      EXPECT_EQ(rule.weights[k], rule.weights[n - 1 - k]);
      if (k > 0) {
        EXPECT_LT(rule.nodes[k - 1], rule.nodes[k]);
      }
    }
  }
}

// The integral of cos(K x + a) over [-h, h] is 2 cos(a) sin(K h)/K; the promise is 2^-60 of 2h, to
// which the sum adds its own rounding, 1e-18 of 2h. For the phases of a row, up to a few, two nodes
// fewer must miss it, or the rule would waste nodes; for large ones the bound behind it is
// generous.
TEST(GaussLegendre, TheCountIsEnoughAndNotTooLarge) {
  for (double phase : {1e-6, 1e-3, 0.05, 0.4, 1.5707963, 3.0, 20.0, 102.1}) {
    const int count = gauss_legendre_count(phase);
    const auto error = [&](int n) {
      const GaussRule rule = gauss_legendre(n);
      long double worst = 0;
      for (long double a : {0.0L, 0.7L}) {
        long double sum = 0;
        for (int i = 0; i < n; ++i) sum += rule.weights[i] * std::cos(phase * rule.nodes[i] + a);
        const long double exact =
            2 * std::cos(a) * std::sin(static_cast<long double>(phase)) / phase;
        worst = std::max(worst, std::abs(sum - exact) / 2);
      }
      return static_cast<double>(worst);
    };
    EXPECT_LE(error(count), 3e-18) << "phase " << phase;
    if (count > 2 && phase < 4) {
      EXPECT_GT(error(count - 2), 3e-18) << "phase " << phase;
    }
  }
}

}  // namespace
}  // namespace shoal
