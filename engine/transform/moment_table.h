// The moment table, the only thing that the workers of one panorama share, and its contraction.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "core/row_band.h"
#include "sphere/coefficients.h"
#include "sphere/quadrature.h"

namespace shoal {

// Row moments of a picture. Every slot is written by one worker, once.
struct MomentTable {
  int channel_count = 0;
  int moment_count = 0;  // 2L+1: C_0..C_L, S_1..S_L
  int row_count = 0;
  std::vector<double> values;  // (channel_count, moment_count, row_count)

  MomentTable() = default;
  MomentTable(int channels, int degree, int rows)
      : channel_count(channels),
        moment_count(2 * degree + 1),
        row_count(rows),
        values(static_cast<std::size_t>(channels) * moment_count * rows) {}

  [[nodiscard]] int degree() const { return (moment_count - 1) / 2; }
  [[nodiscard]] double* column(int channel, int moment) {
    return values.data() + (static_cast<std::size_t>(channel) * moment_count + moment) * row_count;
  }
  [[nodiscard]] const double* column(int channel, int moment) const {
    return const_cast<MomentTable*>(this)->column(channel, moment);
  }
};

// L_lm = azimuth[|m|] sum_i polar(l, |m|, i) moment_m[i], summed from the top row down with each
// row's mirror image beside it; a table of one channel gives three equal ones. Preconditions: the
// weights' height is the table's, their degree L is at most the table's.
[[nodiscard]] Coefficients contract(const MomentTable& table, const ProjectionWeights& weights);

}  // namespace shoal
