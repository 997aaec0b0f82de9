#include "sphere/basis.h"

#include <array>
#include <cmath>

namespace shoal {

template <typename Real>
void Basis<Real>::evaluate(const glm::vec<3, Real>& direction, std::span<Real> values) const {
  const Real sin_theta = std::sqrt(direction.x * direction.x + direction.y * direction.y);
  std::array<Real, legendre_count(kMaxDegree)> pbar;
  legendre_.evaluate(direction.z, sin_theta, pbar);

  // On the axis every function of m != 0 is zero, whatever the azimuth.
  const Real cos_phi = sin_theta > 0 ? direction.x / sin_theta : Real(1);
  const Real sin_phi = sin_theta > 0 ? direction.y / sin_theta : Real(0);
  Real cos_m_phi = 1;
  Real sin_m_phi = 0;
  for (int m = 0; m <= degree(); ++m) {
    for (int l = m; l <= degree(); ++l) {
      const Real p = pbar[legendre_index(l, m)];
      values[coefficient_index(l, m)] = p * cos_m_phi;
      if (m > 0) values[coefficient_index(l, -m)] = p * sin_m_phi;
    }
    const Real next = cos_m_phi * cos_phi - sin_m_phi * sin_phi;
    sin_m_phi = sin_m_phi * cos_phi + cos_m_phi * sin_phi;
    cos_m_phi = next;
  }
}

template class Basis<double>;
template class Basis<long double>;

glm::dvec3 evaluate(const Coefficients& coefficients, std::span<const double> basis) {
  glm::dvec3 sum(0.0);
  for (int c = 0; c < kChannelCount; ++c) {
    const auto& channel = coefficients.channels[c];
    for (std::size_t i = 0; i < channel.size(); ++i) sum[c] += channel[i] * basis[i];
  }
  return sum;
}

glm::dvec3 evaluate(const Coefficients& coefficients, const glm::dvec3& direction) {
  std::vector<double> basis(coefficient_count(coefficients.degree));
  Basis<double>(coefficients.degree).evaluate(direction, basis);
  return evaluate(coefficients, basis);
}

}  // namespace shoal
