// The least attenuation with which no irradiance is negative.
#pragma once

#include <vector>

#include "core/result.h"
#include "sphere/coefficients.h"
#include "sphere/least_irradiance.h"

namespace shoal {

// Gains shared by the channels, to be applied to radiance or irradiance alike.
struct AutomaticWindow {
  std::vector<double> gains;  // g_0 .. g_L in [0, 1], g_0 = 1; exactly 1 where nothing is cut
  LeastIrradiance before;     // without a window
  LeastIrradiance after;      // with it: at least -1e-12
  double change = 0.0;        // ||E - E_windowed|| / ||E||, L2 over the sphere and the channels

  // The degree of least gain, 0 where none is cut.
  [[nodiscard]] int strongest_cut() const;
};

// Among all gains 0 <= g_l <= 1 with g_0 = 1 whose irradiance, in every direction and channel, is
// not negative, those that change irradiance least in L2:
//   minimise   sum_l w_l (1 - g_l)^2,   w_l = A_l^2 sum over channels, orders of L_lm^2
//   subject to sum_l g_l A_l sum_m L_lm Y_lm(x) >= 0   for all directions x, all channels.
// The problem is strictly convex in the degrees that hold irradiance, so the answer is unique, and
// by its optimality conditions (Karush-Kuhn-Tucker) no degree that is cut can be raised alone
// without some direction going negative. Degrees that hold none (odd ones above 1, or where the
// panorama has nothing) keep gain 1. Nothing is cut, and gains are exactly 1, where the light is
// nowhere below -1e-12 of a channel's mean.
// Time: under a millisecond to degree 2, some 20 to degree 10; seconds above degree 30 where
// irradiance is next to zero over wide parts, as under a lone directional light.
// Errors: usage, as least_irradiance (even g = 0 above degree 0 would be negative then); internal,
// should the search not settle.
[[nodiscard]] Result<AutomaticWindow> fit_window(const Coefficients& radiance);

}  // namespace shoal
