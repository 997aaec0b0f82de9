// What tests of quadratures share.
#pragma once

#include <numbers>

#include "sphere/quadrature.h"

namespace shoal {

inline constexpr long double kPi = std::numbers::pi_v<long double>;
inline constexpr double kSphere = 4 * std::numbers::pi;

inline EquirectGrid grid_of(int height, Sampling sampling = Sampling::centers) {
  return {2 * height, height, sampling};
}

// The weight of any row, southern ones by the rule of the header.
inline double polar(const ProjectionWeights& weights, int l, int m, int row) {
  const double* stored = weights.polar_row_weights(l, m);
  if (row < weights.northern_rows) return stored[row];
  return ((l + m) % 2 == 0 ? 1 : -1) * stored[weights.grid.height - 1 - row];
}

}  // namespace shoal
