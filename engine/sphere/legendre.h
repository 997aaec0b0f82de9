// Normalised associated Legendre functions Pbar_lm(cos theta), as sphere/conventions.h defines
// them: without the Condon-Shortley phase, the sqrt(2) of m != 0 included.
#pragma once

#include <span>
#include <vector>

namespace shoal {

// (L+1)(L+2)/2, the number of pairs (l, m), 0 <= m <= l <= L.
[[nodiscard]] constexpr int legendre_count(int degree) { return (degree + 1) * (degree + 2) / 2; }

// The place of (l, m), 0 <= m <= l, in such a triangle.
[[nodiscard]] constexpr int legendre_index(int l, int m) { return l * (l + 1) / 2 + m; }

// The recurrence's constants to one degree, made once and used for many angles by any number of
// threads. Real is double or long double.
//
// Error, for the angles as given: 2e-13 of the largest value of the same (l, m) in double to degree
// 64 (it grows like l^2 next to the poles, as the function's own condition does), 1e-16 in x86 long
// double. An order whose sin^m falls below the smallest normal number is exactly zero.
template <typename Real>
class AssociatedLegendre {
 public:
  // Precondition: 0 <= degree <= kMaxDegree.
  explicit AssociatedLegendre(int degree);

  [[nodiscard]] int degree() const { return degree_; }

  // values[legendre_index(l, m)] = Pbar_lm for all l to the degree. sin_theta >= 0; values holds
  // legendre_count(degree) numbers. Both angles are asked for, because near the poles neither gives
  // the other without loss.
  void evaluate(Real cos_theta, Real sin_theta, std::span<Real> values) const;

 private:
  int degree_ = 0;
  std::vector<Real> sectoral_;  // (degree+1): Pbar_mm = sectoral_[m] sin(theta) Pbar_(m-1)(m-1)
  std::vector<Real> near_;      // by legendre_index: the factor of cos(theta) Pbar_(l-1)m
  std::vector<Real> far_;       // by legendre_index: the factor of Pbar_(l-2)m, to be subtracted
};

extern template class AssociatedLegendre<double>;
extern template class AssociatedLegendre<long double>;

}  // namespace shoal
