// Waldvogel, "Fast Construction of the Fejer and Clenshaw-Curtis Quadrature Rules", BIT 46 (2006),
// gives both rules as cosine sums, eq. 2.2 and 2.4:
//   Fejer            w_i = (2/H) (1 - 2 sum_{k=1..H/2} cos(2 k theta_i) / (4k^2-1))
//   Clenshaw-Curtis  w_i = (c_i/N) (1 - sum_{k=1..N/2} b_k cos(2 k theta_i) / (4k^2-1)),  N = H-1,
//                    b_k = 1 where 2k = N, else 2; c_i = 1 on the poles, else 2.
// Instead of an FFT: 1/(4k^2-1) = (1/(2k-1) - 1/(2k+1))/2, and shifting the second part by one,
//   2 sum_{k=1..K} cos(2 k t)/(4k^2-1) = 1 - 2 sin(t) S_K(t) - cos(2 K t)/(2K+1),
//   S_K(t) = sum_{k=1..K} sin((2k-1) t)/(2k-1) = 1/2 integral over [0, t] of sin(2 K u)/sin(u) du,
// so that one pass over the rows, adding the integral from row to row, gives every S_K(theta_i).
// The integrand is a trigonometric polynomial of degree 2K-1 that turns by less than pi between
// rows.
#include "sphere/polar_rules.h"

#include <cmath>
#include <numbers>

#include "sphere/gauss_legendre.h"

namespace shoal {
namespace {

constexpr long double kPi = std::numbers::pi_v<long double>;

// Half the integral of sin(2 K u)/sin(u) over one row distance pi/N.
class RowIntegral {
 public:
  RowIntegral(int terms, int intervals) : terms_(terms), intervals_(intervals) {
    const long double half_width = kPi / (2.0L * intervals);
    // An even number of nodes, so that none falls on u = 0.
    int count = gauss_legendre_count(static_cast<double>(2 * terms * half_width));
    count += count % 2;
    const GaussRule rule = gauss_legendre(count);
    for (int k = count / 2; k < count; ++k) {
      const long double offset = rule.nodes[k] * half_width;
      nodes_.push_back({std::sin(offset), std::cos(offset), std::sin(2 * terms * offset),
                        std::cos(2 * terms * offset), rule.weights[k] * half_width / 2});
    }
  }

  // Over the interval with the middle pi p/(2N). The phase 2 K u is reduced in integers there.
  [[nodiscard]] long double around(int p) const {
    const long double sin_middle = std::sin(kPi * p / (2.0L * intervals_));
    const long double cos_middle = std::cos(kPi * p / (2.0L * intervals_));
    const long long phase = static_cast<long long>(terms_) * p % (2LL * intervals_);
    const long double sin_phase = std::sin(kPi * phase / intervals_);
    const long double cos_phase = std::cos(kPi * phase / intervals_);
    long double sum = 0;
    for (const Node& node : nodes_) {
      const long double even_part = sin_phase * node.cos_turn;
      const long double odd_part = cos_phase * node.sin_turn;
      const long double even_angle = sin_middle * node.cos_offset;
      const long double odd_angle = cos_middle * node.sin_offset;
      sum += node.weight * ((even_part + odd_part) / (even_angle + odd_angle) +
                            (even_part - odd_part) / (even_angle - odd_angle));
    }
    return sum;
  }

 private:
  struct Node {
    long double sin_offset, cos_offset, sin_turn, cos_turn, weight;
  };
  int terms_;
  int intervals_;
  std::vector<Node> nodes_;
};

long double alternating(int i) { return i % 2 == 0 ? 1.0L : -1.0L; }

}  // namespace

std::vector<long double> fejer_weights(int height) {
  const int terms = height / 2;
  const RowIntegral integral(terms, height);
  std::vector<long double> weights((height + 1) / 2);
  long double sine_sum = 0;
  for (int i = 0; i < static_cast<int>(weights.size()); ++i) {
    // Row 0 lies half a distance from u = 0, about which the integrand is even.
    sine_sum += i == 0 ? integral.around(0) / 2 : integral.around(2 * i);
    const long double sin_theta = std::sin(kPi * (2 * i + 1) / (2.0L * height));
    // cos(2 K theta_i) is cos(pi (i+1/2)) = 0 for an even height, else (-1)^i sin(theta_i).
    const long double last = height % 2 == 0 ? 0.0L : alternating(i) / (2 * terms + 1);
    weights[i] = 2 * sin_theta * (2 * sine_sum + last) / height;
  }
  return weights;
}

std::vector<long double> clenshaw_curtis_weights(int height) {
  const int n = height - 1;
  const int terms = n / 2;
  const RowIntegral integral(terms, n);
  std::vector<long double> weights((height + 1) / 2);
  long double sine_sum = 0;
  for (int i = 0; i < static_cast<int>(weights.size()); ++i) {
    if (i > 0) sine_sum += integral.around(2 * i - 1);
    const long double theta = kPi * i / n;
    // cos(2 K theta_i) is (-1)^i for an even n, else (-1)^i cos(theta_i); for an even n half of the
    // last term of the sum, (-1)^i/(n^2-1), is added back: 1/(n+1) + 1/(n^2-1) = n/(n^2-1).
    const long double last =
        alternating(i) *
        (n % 2 == 0 ? n / (static_cast<long double>(n) * n - 1) : std::cos(theta) / n);
    weights[i] = (i == 0 ? 1 : 2) * (2 * std::sin(theta) * sine_sum + last) / n;
  }
  return weights;
}

}  // namespace shoal
