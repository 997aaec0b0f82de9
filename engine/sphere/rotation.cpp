// Ivanic & Ruedenberg, "Rotation Matrices for Real Spherical Harmonics. Direct Determination by
// Recursion", J. Phys. Chem. 100 (1996), 6342, with the corrections of J. Phys. Chem. A 102 (1998),
// 9099: R^l from R^(l-1) and R^1. The recursion couples Y_1 and Y_(l-1) to Y_l, which holds for
// every orthogonal map, so reflections need nothing of their own.
#include "sphere/rotation.h"

#include <cmath>
#include <cstdlib>

namespace shoal {
namespace {

// Rounding grows with the degree along the recursion; long double keeps it below a double's last
// bit.
using Real = long double;

// One degree's matrix, indices -l..l.
struct Block {
  int l = 0;
  std::vector<Real> values;

  explicit Block(int l_in) : l(l_in), values((2 * l + 1) * (2 * l + 1)) {}
  Real& at(int m, int n) { return values[(m + l) * (2 * l + 1) + n + l]; }
  [[nodiscard]] Real at(int m, int n) const { return values[(m + l) * (2 * l + 1) + n + l]; }
};

// Y_1m is y, z, x for m = -1, 0, 1.
Block first_block(const glm::dmat3& orthogonal) {
  constexpr int kAxis[3] = {1, 2, 0};
  Block block(1);
  for (int m = -1; m <= 1; ++m) {
    for (int n = -1; n <= 1; ++n) block.at(m, n) = orthogonal[kAxis[n + 1]][kAxis[m + 1]];
  }
  return block;
}

// _iP_(mu,n) of table 2.
Real coupled(const Block& first, const Block& below, int i, int mu, int n) {
  const int l = below.l + 1;
  if (n == l) {
    return first.at(i, 1) * below.at(mu, l - 1) - first.at(i, -1) * below.at(mu, -l + 1);
  }
  if (n == -l) {
    return first.at(i, 1) * below.at(mu, -l + 1) + first.at(i, -1) * below.at(mu, l - 1);
  }
  return first.at(i, 0) * below.at(mu, n);
}

// V_mn of table 2, as the errata give it.
Real v_term(const Block& first, const Block& below, int m, int n) {
  const Real sqrt_two = std::sqrt(Real(2));
  if (m == 0) return coupled(first, below, 1, 1, n) + coupled(first, below, -1, -1, n);
  if (m == 1) return sqrt_two * coupled(first, below, 1, 0, n);
  if (m == -1) return sqrt_two * coupled(first, below, -1, 0, n);
  if (m > 0) return coupled(first, below, 1, m - 1, n) - coupled(first, below, -1, -m + 1, n);
  return coupled(first, below, 1, m + 1, n) + coupled(first, below, -1, -m - 1, n);
}

// W_mn of table 2, as the errata give it; m != 0.
Real w_term(const Block& first, const Block& below, int m, int n) {
  if (m > 0) return coupled(first, below, 1, m + 1, n) + coupled(first, below, -1, -m - 1, n);
  return coupled(first, below, 1, m - 1, n) - coupled(first, below, -1, -m + 1, n);
}

// The factors u, v, w of table 1 but for their common denominator. A factor is zero exactly where
// its term would reach outside R^(l-1).
struct RowFactors {
  Real u, v, w;
};

RowFactors row_factors(int l, int m) {
  const int k = std::abs(m);
  if (m == 0) return {Real(l), -std::sqrt(Real(2 * (l - 1)) * l) / 2, 0};
  return {std::sqrt(Real(l + k) * (l - k)), std::sqrt(Real(l + k - 1) * (l + k)) / 2,
          -std::sqrt(Real(l - k - 1) * (l - k)) / 2};
}

Block next_block(const Block& first, const Block& below) {
  const int l = below.l + 1;
  Block block(l);
  std::vector<Real> column_factors(2 * l + 1, 1 / std::sqrt(Real(2 * l) * (2 * l - 1)));
  for (int n = -l + 1; n < l; ++n) column_factors[n + l] = 1 / std::sqrt(Real(l + n) * (l - n));

  for (int m = -l; m <= l; ++m) {
    const RowFactors factors = row_factors(l, m);
    for (int n = -l; n <= l; ++n) {
      Real sum = factors.v * v_term(first, below, m, n);
      if (factors.u != 0) sum += factors.u * coupled(first, below, 0, m, n);
      if (factors.w != 0) sum += factors.w * w_term(first, below, m, n);
      block.at(m, n) = sum * column_factors[n + l];
    }
  }
  return block;
}

}  // namespace

Rotation::Rotation(const glm::dmat3& orthogonal, int degree)
    : identity_(orthogonal == glm::dmat3(1.0)) {
  blocks_.push_back({1.0});
  if (degree == 0) return;
  const Block first = first_block(orthogonal);
  Block block = first;
  for (int l = 1; l <= degree; ++l) {
    if (l > 1) block = next_block(first, block);
    blocks_.emplace_back(block.values.begin(), block.values.end());
  }
}

Coefficients Rotation::apply(const Coefficients& coefficients) const {
  if (identity_) return coefficients;
  Coefficients turned(coefficients.degree);
  for (int l = 0; l <= coefficients.degree; ++l) {
    const int width = 2 * l + 1;
    const int begin = l * l;
    for (int c = 0; c < kChannelCount; ++c) {
      for (int m = 0; m < width; ++m) {
        Real sum = 0;
        for (int n = 0; n < width; ++n) {
          sum += Real(blocks_[l][m * width + n]) * coefficients.channels[c][begin + n];
        }
        turned.channels[c][begin + m] = static_cast<double>(sum);
      }
    }
  }
  return turned;
}

Coefficients rotate(const Coefficients& coefficients, const glm::dmat3& orthogonal) {
  return Rotation(orthogonal, coefficients.degree).apply(coefficients);
}

}  // namespace shoal
