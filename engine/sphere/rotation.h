// Exact rotation of real spherical harmonics.
#pragma once

#include <glm/mat3x3.hpp>
#include <span>
#include <vector>

#include "sphere/coefficients.h"

namespace shoal {

// How an orthogonal map R of space, rotation or reflection, acts on the coefficients of a function:
// f'(x) = f(R^-1 x), what stood at x stands at R x. Each degree is turned by its own orthogonal
// matrix, so every degree keeps its power. Error of a matrix entry: 1e-14 at degree 64, and l times
// R's own distance from orthogonal.
class Rotation {
 public:
  // Preconditions: R orthogonal to a few units in the last place, 0 <= degree <= kMaxDegree.
  Rotation(const glm::dmat3& orthogonal, int degree);

  [[nodiscard]] int degree() const { return static_cast<int>(blocks_.size()) - 1; }

  // The (2l+1) x (2l+1) matrix of degree l, row-major; row m+l gives c'_lm, column n+l takes c_ln.
  [[nodiscard]] std::span<const double> block(int l) const { return blocks_[l]; }

  // Precondition: the coefficients' degree is at most this one's. The identity leaves the bits as
  // they are.
  [[nodiscard]] Coefficients apply(const Coefficients& coefficients) const;

 private:
  bool identity_ = false;
  std::vector<std::vector<double>> blocks_;
};

// The same in one go.
[[nodiscard]] Coefficients rotate(const Coefficients& coefficients, const glm::dmat3& orthogonal);

}  // namespace shoal
