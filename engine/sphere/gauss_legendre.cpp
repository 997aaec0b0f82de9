#include "sphere/gauss_legendre.h"

#include <cmath>
#include <limits>
#include <numbers>

namespace shoal {
namespace {

struct LegendreValue {
  long double value = 0;       // P_n(x)
  long double derivative = 0;  // P_n'(x)
};

LegendreValue legendre_polynomial(int n, long double x) {
  long double previous = 1;
  long double current = x;
  for (int k = 2; k <= n; ++k) {
    const long double next = ((2 * k - 1) * x * current - (k - 1) * previous) / k;
    previous = current;
    current = next;
  }
  return {current, n * (x * current - previous) / (x * x - 1)};
}

}  // namespace

GaussRule gauss_legendre(int count) {
  GaussRule rule{std::vector<long double>(count), std::vector<long double>(count)};
  for (int k = 0; k < (count + 1) / 2; ++k) {
    // Newton's method from Tricomi's estimate of the k-th root, 1 - O(n^-2) of it away.
    long double x = std::cos(std::numbers::pi_v<long double> * (k + 0.75L) / (count + 0.5L));
    const bool centre = 2 * k + 1 == count;
    if (centre) x = 0;
    LegendreValue p = legendre_polynomial(count, x);
    for (int step = 0; step < 10 && !centre; ++step) {
      const long double change = p.value / p.derivative;
      x -= change;
      p = legendre_polynomial(count, x);
      if (std::abs(change) < 4 * std::numeric_limits<long double>::epsilon()) break;
    }
    rule.nodes[k] = -x;
    rule.nodes[count - 1 - k] = x;
    rule.weights[k] = rule.weights[count - 1 - k] = 2 / ((1 - x * x) * p.derivative * p.derivative);
  }
  return rule;
}

// The error of n nodes on [-h, h] is 2 h f^(2n)(t) h^(2n) c_n with
// c_n = 2^(2n) (n!)^4 / ((2n+1) ((2n)!)^3), and |f^(2n)| <= K^(2n) max|f| by Bernstein's
// inequality. c_n / c_(n-1) = n / (2 (2n+1) (2n-1)^2), c_0 = 1.
int gauss_legendre_count(double phase) {
  const double target = std::ldexp(1.0, -60);
  double bound = 1.0;
  int n = 0;
  do {
    ++n;
    bound *= phase * phase * n / (2.0 * (2 * n + 1) * (2 * n - 1) * (2 * n - 1));
  } while (bound > target);
  return n;
}

}  // namespace shoal
