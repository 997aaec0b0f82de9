// How far two equirect pictures are apart, in light.
#pragma once

#include <vector>

#include "library/pixels.h"
#include "scenes/scene.h"
#include "window/picture.h"

namespace shoal::viz {

struct Difference {
  std::vector<double> values;  // right minus left a texel, in the channel
  double rms = 0.0;            // over the sphere: rows weigh as their solid angles do
  double relative_rms = 0.0;   // of the left side's own RMS; 0 where that is 0
  double largest = 0.0;        // |value|
  std::size_t largest_texel = 0;
  double scale = 1.0;   // |value| at which the colours end: all but kBeyondScale of the texels lie
                        // inside, so that a sun does not take the colours from all the rest
  double beyond = 0.0;  // the part of the texels whose |value| is larger than that
};

inline constexpr double kBeyondScale = 0.005;

// Precondition: both have the same size, at least one texel.
[[nodiscard]] Difference difference_of(const Pixels& left, const Pixels& right, Channel channel);

// diverging_colour of value over scale. `like` has the size.
[[nodiscard]] Picture difference_picture(const Difference& difference, const Pixels& like);

}  // namespace shoal::viz
