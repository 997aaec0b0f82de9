// Which texels of a smaller equirect grid a texel covers, along one axis.
#pragma once

#include <vector>

#include "sphere/quadrature.h"

namespace shoal {

// A texel's shares in texel `first` of the smaller grid and in the one behind it, as parts of
// theirs: what all texels give to one of the smaller grid sums to 1 (to 1e-6).
struct AreaShare {
  int first = 0;
  float weight = 0.0F;
  float weight_behind = 0.0F;
};

// Shares by angle phi, and by solid angle, which is by cos(theta). With Sampling::endpoints a texel
// stands for the cell around it that is nearer to it than to its neighbours, half of that at a pole
// and on either side of the seam.
// Precondition: 1 <= small <= count, less than count for endpoints.
[[nodiscard]] std::vector<AreaShare> column_shares(int count, int small, Sampling sampling);
[[nodiscard]] std::vector<AreaShare> row_shares(int count, int small, Sampling sampling);

}  // namespace shoal
