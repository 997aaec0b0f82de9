// Sums of harmonics at the texel centres of an equirect picture, in double and without SIMD.
#pragma once

#include <glm/vec3.hpp>
#include <span>
#include <vector>

namespace shoal {

// The tables of one degree and size, for any number of functions. Bits do not depend on the
// processor.
class EquirectEvaluator {
 public:
  // Preconditions: 0 <= degree <= kMaxDegree; columns, rows >= 1.
  EquirectEvaluator(int degree, int columns, int rows);

  [[nodiscard]] int columns() const { return columns_; }
  [[nodiscard]] int rows() const { return rows_; }

  // values[j] = sum_lm coefficients[l(l+1)+m] Y_lm(texel (row, j)). `coefficients`: (degree+1)^2;
  // `values`: (columns).
  void evaluate(std::span<const double> coefficients, int row, std::span<double> values) const;

  // Of a texel's centre: unit, native frame.
  [[nodiscard]] glm::dvec3 direction(int row, int column) const;
  // Of the sphere that one texel of the row covers.
  [[nodiscard]] double share(int row) const;

 private:
  int degree_ = 0;
  int columns_ = 0;                              // phi_j = 2 pi (j+1/2)/columns
  int rows_ = 0;                                 // theta_i = pi (i+1/2)/rows
  std::vector<double> legendre_;                 // (rows, (degree+1)(degree+2)/2)
  std::vector<double> cosines_, sines_;          // (degree+1, columns): of m phi_j
  std::vector<double> row_cosines_, row_sines_;  // (rows): of theta_i
};

}  // namespace shoal
