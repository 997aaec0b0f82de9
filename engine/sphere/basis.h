// The basis functions Y_lm of sphere/conventions.h at a direction, and sums over them.
#pragma once

#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>
#include <span>

#include "sphere/coefficients.h"
#include "sphere/legendre.h"

namespace shoal {

// Y_lm to one degree, made once and used for many directions by any number of threads.
// Real is double or long double. Error: that of AssociatedLegendre.
template <typename Real>
class Basis {
 public:
  // Precondition: 0 <= degree <= kMaxDegree.
  explicit Basis(int degree) : legendre_(degree) {}

  [[nodiscard]] int degree() const { return legendre_.degree(); }

  // values[coefficient_index(l, m)] = Y_lm(direction). The direction is of unit length, in the
  // native frame; values holds coefficient_count(degree) numbers.
  void evaluate(const glm::vec<3, Real>& direction, std::span<Real> values) const;

 private:
  AssociatedLegendre<Real> legendre_;
};

extern template class Basis<double>;
extern template class Basis<long double>;

// sum of c_lm Y_lm, RGB, in the coefficients' unit. `basis` holds the values of Y_lm, at least to
// the coefficients' degree.
[[nodiscard]] glm::dvec3 evaluate(const Coefficients& coefficients, std::span<const double> basis);

// The same at one unit direction. For many directions make a Basis once.
[[nodiscard]] glm::dvec3 evaluate(const Coefficients& coefficients, const glm::dvec3& direction);

}  // namespace shoal
