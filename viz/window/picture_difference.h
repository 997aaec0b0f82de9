// How far two pictures are apart: the metric by which pictures are checked against baselines.
#pragma once

#include "core/result.h"
#include "window/picture.h"

namespace shoal::viz {

// A pixel's difference is the largest of its three channels' differences, in steps of 8-bit sRGB.
//
//   largest 0                     the same picture, as it is from run to run on one machine
//   largest <= 2                  no eye tells them apart; other roundings of one rasteriser
//   share < 0.01 (threshold 16)   the same scene by another rasteriser: edges differ
//   share > 0.01                  another scene
struct PictureDifference {
  int largest = 0;     // over all pixels, 0 to 255
  double mean = 0.0;   // of the pixels' differences, 0 to 255
  double share = 0.0;  // of pixels whose difference is above the threshold, 0 to 1
};

inline constexpr int kDifferenceThreshold = 16;

// Error: usage, where the sizes differ.
[[nodiscard]] Result<PictureDifference> compare_pictures(const Picture& a, const Picture& b,
                                                         int threshold = kDifferenceThreshold);

// The differences themselves, eight times as strong, on black; to be looked at.
// Precondition: both are of one size.
[[nodiscard]] Picture difference_picture(const Picture& a, const Picture& b);

}  // namespace shoal::viz
