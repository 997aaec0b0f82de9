#include "transform/reference_projector.h"

#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

#include "sphere/gauss_legendre.h"

namespace shoal {
namespace {

constexpr long double kPi = std::numbers::pi_v<long double>;

long double polar_angle(const EquirectGrid& grid, int row) {
  if (grid.sampling == Sampling::endpoints) return kPi * row / (grid.height - 1);
  return kPi * (row + 0.5L) / grid.height;
}

// Fejer's first rule and Clenshaw-Curtis as their defining cosine sums (Waldvogel 2006, section 2).
long double interpolatory_weight(const EquirectGrid& grid, int row) {
  const long double theta = polar_angle(grid, row);
  if (grid.sampling == Sampling::centers) {
    long double sum = 0.0L;
    for (int k = 1; k <= grid.height / 2; ++k) {
      sum += std::cos(2.0L * k * theta) / (4.0L * k * k - 1.0L);
    }
    return 2.0L / grid.height * (1.0L - 2.0L * sum);
  }
  const int n = grid.height - 1;
  long double sum = 1.0L;
  for (int k = 1; k <= n / 2; ++k) {
    const long double b = 2 * k == n ? 1.0L : 2.0L;
    sum -= b * std::cos(2.0L * k * theta) / (4.0L * k * k - 1.0L);
  }
  return (row == 0 || row == n ? 1.0L : 2.0L) * sum / n;
}

// The weight of (order, column): the integral of cos(m phi) over the texel is cos(m phi_j) dphi
// sin(m dphi/2)/(m dphi/2), likewise with sin; other rules take the value times dphi.
long double azimuth_weight(const EquirectGrid& grid, Quadrature quadrature, int order, int column) {
  if (grid.sampling == Sampling::endpoints) {
    const bool seam = column == 0 || column == grid.width - 1;
    return 2.0L * kPi / (grid.width - 1) * (seam ? 0.5L : 1.0L);
  }
  const long double step = 2.0L * kPi / grid.width;
  if (quadrature != Quadrature::texel || order == 0) return step;
  return 2.0L * std::sin(order * step / 2.0L) / order;
}

Coefficients rounded(int degree, const std::array<std::vector<long double>, kChannelCount>& sums) {
  Coefficients result(degree);
  for (int c = 0; c < kChannelCount; ++c) {
    for (std::size_t i = 0; i < sums[c].size(); ++i) {
      result.channels[c][i] = static_cast<double>(sums[c][i]);
    }
  }
  return result;
}

}  // namespace

ReferenceProjector::ReferenceProjector(const EquirectGrid& grid, Quadrature quadrature, int degree)
    : grid_(grid),
      quadrature_(quadrature),
      degree_(degree),
      legendre_(degree),
      polar_(legendre_count(degree)),
      azimuth_(static_cast<std::size_t>(grid.width) * (2 * degree + 1)) {
  for (auto& channel : sums_) channel.assign(coefficient_count(degree), 0.0L);
  const int intervals = grid.sampling == Sampling::endpoints ? grid.width - 1 : grid.width;
  const long double offset = grid.sampling == Sampling::endpoints ? 0.0L : 0.5L;
  for (int j = 0; j < grid.width; ++j) {
    long double* values = azimuth_.data() + static_cast<std::size_t>(j) * (2 * degree + 1);
    for (int m = 0; m <= degree; ++m) {
      const long double angle = 2.0L * kPi * m * (j + offset) / intervals;
      const long double weight = azimuth_weight(grid, quadrature, m, j);
      values[m] = weight * std::cos(angle);
      if (m > 0) values[degree + m] = weight * std::sin(angle);
    }
  }
}

void ReferenceProjector::enter_row(int row) {
  row_ = row;
  const long double theta = polar_angle(grid_, row);
  std::vector<long double> values(polar_.size());
  std::fill(polar_.begin(), polar_.end(), 0.0L);
  const auto add = [&](long double angle, long double weight) {
    legendre_.evaluate(std::cos(angle), std::sin(angle), values);
    for (std::size_t i = 0; i < polar_.size(); ++i) polar_[i] += weight * values[i];
  };
  switch (quadrature_) {
    case Quadrature::texel: {
      const long double half_step = kPi / grid_.height / 2.0L;
      const GaussRule rule =
          gauss_legendre(gauss_legendre_count(static_cast<double>((degree_ + 1) * half_step)));
      for (std::size_t k = 0; k < rule.nodes.size(); ++k) {
        const long double angle = theta + half_step * rule.nodes[k];
        add(angle, half_step * rule.weights[k] * std::sin(angle));
      }
      break;
    }
    case Quadrature::midpoint:
      add(theta, kPi / grid_.height * std::sin(theta));
      break;
    case Quadrature::fejer:
    case Quadrature::clenshaw_curtis:
      add(theta, interpolatory_weight(grid_, row));
      break;
  }
}

void ReferenceProjector::add_pixel(int row, int column,
                                   const std::array<float, kChannelCount>& sample) {
  if (row != row_) enter_row(row);
  const long double* azimuth =
      azimuth_.data() + static_cast<std::size_t>(column) * (2 * degree_ + 1);
  for (int l = 0; l <= degree_; ++l) {
    for (int m = -l; m <= l; ++m) {
      const long double trig = m >= 0 ? azimuth[m] : azimuth[degree_ - m];
      const long double basis = polar_[legendre_index(l, m < 0 ? -m : m)] * trig;
      const int index = coefficient_index(l, m);
      for (int c = 0; c < kChannelCount; ++c) sums_[c][index] += sample[c] * basis;
    }
  }
}

Coefficients ReferenceProjector::coefficients() const { return rounded(degree_, sums_); }

DirectionReference::DirectionReference(int degree)
    : basis_(degree), values_(coefficient_count(degree)) {
  for (auto& channel : sums_) channel.assign(values_.size(), 0.0L);
}

void DirectionReference::add_texel(const Texel& texel,
                                   const std::array<float, kChannelCount>& sample) {
  basis_.evaluate(glm::normalize(glm::vec<3, long double>(texel.direction)), values_);
  for (int c = 0; c < kChannelCount; ++c) {
    const long double light = static_cast<long double>(texel.solid_angle) * sample[c];
    for (std::size_t i = 0; i < values_.size(); ++i) sums_[c][i] += light * values_[i];
  }
}

Coefficients DirectionReference::coefficients() const { return rounded(basis_.degree(), sums_); }

}  // namespace shoal
