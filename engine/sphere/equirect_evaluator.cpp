#include "sphere/equirect_evaluator.h"

#include <cmath>
#include <numbers>

#include "sphere/conventions.h"
#include "sphere/legendre.h"

namespace shoal {
namespace {

// long double's functions are the same on every x86-64; double's depend on whether the CPU fuses.
using Real = long double;
constexpr Real kPi = std::numbers::pi_v<Real>;

}  // namespace

EquirectEvaluator::EquirectEvaluator(int degree, int columns, int rows)
    : degree_(degree),
      columns_(columns),
      rows_(rows),
      legendre_(static_cast<std::size_t>(rows) * legendre_count(degree)) {
  // All angles m phi_j are multiples of pi / columns.
  std::vector<double> cosine, sine;
  for (int k = 0; k < 2 * columns; ++k) {
    cosine.push_back(static_cast<double>(std::cos(kPi * k / columns)));
    sine.push_back(static_cast<double>(std::sin(kPi * k / columns)));
  }
  for (int m = 0; m <= degree; ++m) {
    for (int j = 0; j < columns; ++j) {
      cosines_.push_back(cosine[(2 * j + 1) * m % (2 * columns)]);
      sines_.push_back(sine[(2 * j + 1) * m % (2 * columns)]);
    }
  }
  const AssociatedLegendre<double> legendre(degree);
  const std::size_t count = legendre_count(degree);
  for (int i = 0; i < rows; ++i) {
    const Real theta = kPi * (2 * i + 1) / (2 * rows);
    row_cosines_.push_back(static_cast<double>(std::cos(theta)));
    row_sines_.push_back(static_cast<double>(std::sin(theta)));
    legendre.evaluate(row_cosines_.back(), row_sines_.back(),
                      std::span(legendre_).subspan(i * count, count));
  }
}

void EquirectEvaluator::evaluate(std::span<const double> coefficients, int row,
                                 std::span<double> values) const {
  const double* pbar = legendre_.data() + static_cast<std::size_t>(row) * legendre_count(degree_);
  for (int m = 0; m <= degree_; ++m) {
    double even = 0.0, odd = 0.0;  // the factors of cos(m phi), sin(m phi)
    for (int l = m; l <= degree_; ++l) {
      even += coefficients[coefficient_index(l, m)] * pbar[legendre_index(l, m)];
      if (m > 0) odd += coefficients[coefficient_index(l, -m)] * pbar[legendre_index(l, m)];
    }
    const double* cosine = cosines_.data() + static_cast<std::size_t>(m) * columns_;
    const double* sine = sines_.data() + static_cast<std::size_t>(m) * columns_;
    for (int j = 0; j < columns_; ++j) {
      values[j] = (m == 0 ? 0.0 : values[j]) + even * cosine[j] + odd * sine[j];
    }
  }
}

glm::dvec3 EquirectEvaluator::direction(int row, int column) const {
  const Real phi = kPi * (2 * column + 1) / columns_;
  return {row_sines_[row] * static_cast<double>(std::cos(phi)),
          row_sines_[row] * static_cast<double>(std::sin(phi)), row_cosines_[row]};
}

// cos(pi i/rows) - cos(pi (i+1)/rows) = 2 sin(theta_i) sin(pi/(2 rows)), halved and divided among
// the columns.
double EquirectEvaluator::share(int row) const {
  return row_sines_[row] * static_cast<double>(std::sin(kPi / (2 * rows_)) / columns_);
}

}  // namespace shoal
