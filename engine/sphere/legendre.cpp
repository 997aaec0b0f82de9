#include "sphere/legendre.h"

#include <cmath>
#include <limits>
#include <numbers>

namespace shoal {

// Up the degrees at fixed order, from the sectoral values: the forward column recurrence, which is
// stable for every l >= m (Holmes & Featherstone, "A unified approach to the Clenshaw summation and
// the recursive computation of very high degree and order normalised associated Legendre
// functions", J. Geodesy 76 (2002), eq. 11-13):
//   Pbar_lm = a_lm (cos(theta) Pbar_(l-1)m - Pbar_(l-2)m / a_(l-1)m),
//   a_lm = sqrt((4 l^2 - 1) / (l^2 - m^2)).
template <typename Real>
AssociatedLegendre<Real>::AssociatedLegendre(int degree)
    : degree_(degree),
      sectoral_(degree + 1),
      near_(legendre_count(degree)),
      far_(legendre_count(degree)) {
  sectoral_[0] = std::sqrt(std::numbers::inv_pi_v<Real> / 4);
  for (int m = 1; m <= degree; ++m) {
    const Real sqrt_two_enters = m == 1 ? 2 : 1;
    sectoral_[m] = std::sqrt(sqrt_two_enters * Real(2 * m + 1) / Real(2 * m));
  }
  const auto a = [](int l, int m) { return std::sqrt(Real(4 * l * l - 1) / Real(l * l - m * m)); };
  for (int l = 1; l <= degree; ++l) {
    for (int m = 0; m < l; ++m) {
      near_[legendre_index(l, m)] = a(l, m);
      far_[legendre_index(l, m)] = m < l - 1 ? a(l, m) / a(l - 1, m) : Real(0);
    }
  }
}

template <typename Real>
void AssociatedLegendre<Real>::evaluate(Real cos_theta, Real sin_theta,
                                        std::span<Real> values) const {
  Real sectoral = sectoral_[0];
  values[0] = sectoral;
  for (int l = 1; l <= degree_; ++l) {
    Real* row = values.data() + legendre_index(l, 0);
    const Real* below = row - l;
    const Real* two_below = below - (l - 1);
    const Real* near = near_.data() + legendre_index(l, 0);
    const Real* far = far_.data() + legendre_index(l, 0);
    for (int m = 0; m < l - 1; ++m) {
      row[m] = near[m] * (cos_theta * below[m]) - far[m] * two_below[m];
    }
    row[l - 1] = near[l - 1] * (cos_theta * below[l - 1]);

    sectoral *= sectoral_[l] * sin_theta;
    // A subnormal seed would carry its few digits up the whole column.
    if (sectoral < std::numeric_limits<Real>::min()) sectoral = 0;
    row[l] = sectoral;
  }
}

template class AssociatedLegendre<double>;
template class AssociatedLegendre<long double>;

}  // namespace shoal
