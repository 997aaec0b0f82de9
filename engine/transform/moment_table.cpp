#include "transform/moment_table.h"

namespace shoal {
namespace {

// Four interleaved sums, added pairwise: one chain of additions would wait for itself at every row.
template <typename Term>
double sum_in_fours(int count, const Term& term) {
  std::array<double, 4> sums{};
  int i = 0;
  for (; i + 4 <= count; i += 4) {
    for (int lane = 0; lane < 4; ++lane) sums[lane] += term(i + lane);
  }
  for (; i < count; ++i) sums[i % 4] += term(i);
  return (sums[0] + sums[1]) + (sums[2] + sums[3]);
}

// polar(l, m, H-1-i) = (-1)^(l+m) polar(l, m, i), so that both rows cost one product.
double contract_rows(const double* polar, const double* moments, int height, int parity) {
  const int pairs = height / 2;
  const double* mirrored = moments + height - 1;
  double sum =
      parity % 2 == 0
          ? sum_in_fours(pairs, [&](int i) { return polar[i] * (moments[i] + mirrored[-i]); })
          : sum_in_fours(pairs, [&](int i) { return polar[i] * (moments[i] - mirrored[-i]); });
  if (height % 2 == 1) sum += polar[pairs] * moments[pairs];
  return sum;
}

}  // namespace

Coefficients contract(const MomentTable& table, const ProjectionWeights& weights) {
  const int degree = weights.degree;
  Coefficients result(degree);
  for (int c = 0; c < table.channel_count; ++c) {
    for (int l = 0; l <= degree; ++l) {
      for (int m = -l; m <= l; ++m) {
        const int order = m < 0 ? -m : m;
        const double* moments = table.column(c, m < 0 ? table.degree() + order : order);
        result.channels[c][coefficient_index(l, m)] =
            weights.azimuth[order] *
            contract_rows(weights.polar_row_weights(l, order), moments, table.row_count, l + order);
      }
    }
  }
  for (int c = table.channel_count; c < kChannelCount; ++c) result.channels[c] = result.channels[0];
  return result;
}

}  // namespace shoal
