// What happens to pixel values that are not ordinary light, and the record of what was met.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <limits>
#include <span>
#include <string>
#include <vector>

#include "core/row_band.h"

namespace shoal {

// What happens to pixel values that are not ordinary light. The only part that is not linear.
struct PixelPolicy {
  enum class NonFinite { error, zero };
  enum class Negative { keep, zero };
  NonFinite nonfinite = NonFinite::error;
  Negative negative = Negative::keep;
  // Samples above this become this, in the file's own units; 0: no clamp.
  double clamp = 0.0;
  // The same with the value above which all but this percentage of the sphere's solid angle lies,
  // in [99, 100); 0: no such clamp. A clamp by value comes before it.
  double clamp_percentile = 0.0;
};

// What was met in the pixels, in the file's own samples: before its EXPOSURE, its colour matrix or
// any operation. Extremes are of the finite samples before any policy, the mean is of the samples
// projected.
struct PixelReport {
  std::array<double, 3> minimum{};
  std::array<double, 3> maximum{};
  std::array<double, 3> mean{};
  std::int64_t pixel_count = 0;
  std::int64_t nonfinite_count = 0;  // pixels with at least one such channel
  std::int64_t negative_count = 0;
  std::int64_t clamped_count = 0;
  std::array<double, 3> clamped_flux{};  // integral over the sphere of what the clamp took away
  double clamp_threshold = 0.0;          // that the clamp really used; 0: no clamp
  // How far the clamp moved the colour of the mean radiance: the distance in the CIE 1976 (u', v')
  // diagram, in which about 0.004 is just seen; 0 where a mean has no colour.
  double clamp_colour_shift = 0.0;
};

// What a person should know of it, a sentence each; nothing where all was ordinary light.
[[nodiscard]] std::vector<std::string> warnings_of(const PixelReport& report,
                                                   const PixelPolicy& policy);

// The counts and extremes of some scanlines. Merging is order-invariant.
struct PixelTally {
  std::array<double, kMaxChannels> minimum;
  std::array<double, kMaxChannels> maximum;
  std::int64_t nonfinite_count = 0;  // pixels with at least one such channel
  std::int64_t negative_count = 0;
  std::int64_t clamped_count = 0;
  // The first non-finite pixel in picture order.
  std::int64_t first_nonfinite_row = std::numeric_limits<std::int64_t>::max();
  std::int64_t first_nonfinite_column = 0;

  PixelTally();
  void see_extremes(int channel, double low, double high);
  void see_nonfinite(std::int64_t row, std::int64_t column);
  void merge(const PixelTally& other);
};

// One scanline as floats, one plane a channel, on its way through the policy.
struct PolicyRow {
  std::array<std::span<float>, kMaxChannels> channels;
  int channel_count = 0;
};

// Where a scanline's samples lie in the picture, for saying where the first bad one is.
struct ScanlinePlace {
  std::int64_t row = 0;     // of the first sample
  std::int64_t column = 0;  // of the first sample
  int row_step = 0;         // from one sample to the next
  int column_step = 1;
};

// Called for every sample that the clamp changes, with what it took away.
using OnClamp = std::function<void(int channel, std::size_t sample, double amount)>;

// Tallies the row and applies the policy to it in place.
void apply_pixel_policy(const PixelPolicy& policy, const PolicyRow& row, const ScanlinePlace& place,
                        PixelTally& tally, const OnClamp& on_clamp);

}  // namespace shoal
