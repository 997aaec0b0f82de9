#include "transform/pixel_policy.h"

#include <algorithm>
#include <cmath>
#include <tuple>

#include <fmt/format.h>

namespace shoal {

std::vector<std::string> warnings_of(const PixelReport& report, const PixelPolicy& policy) {
  std::vector<std::string> warnings;
  if (report.nonfinite_count > 0) {
    warnings.push_back(fmt::format("{} of {} pixels are not finite and were taken as black",
                                   report.nonfinite_count, report.pixel_count));
  }
  if (report.negative_count > 0) {
    const double lowest = *std::ranges::min_element(report.minimum);
    warnings.push_back(
        fmt::format("{} of {} pixels are negative, down to {:.4g}; they were {}",
                    report.negative_count, report.pixel_count, lowest,
                    policy.negative == PixelPolicy::Negative::zero ? "set to 0" : "kept"));
  }
  if (report.clamped_count > 0) {
    const auto& flux = report.clamped_flux;
    warnings.push_back(fmt::format(
        "{} of {} pixels were clamped to {:g}, which took away {:.4g}, {:.4g}, {:.4g} of "
        "red, green and blue flux over the sphere and moved the mean colour by {:.2g} in CIE u'v'",
        report.clamped_count, report.pixel_count, report.clamp_threshold, flux[0], flux[1], flux[2],
        report.clamp_colour_shift));
  }
  return warnings;
}

PixelTally::PixelTally() {
  minimum.fill(std::numeric_limits<double>::infinity());
  maximum.fill(-std::numeric_limits<double>::infinity());
}

void PixelTally::see_extremes(int channel, double low, double high) {
  minimum[channel] = std::min(minimum[channel], low);
  maximum[channel] = std::max(maximum[channel], high);
}

void PixelTally::see_nonfinite(std::int64_t row, std::int64_t column) {
  ++nonfinite_count;
  if (std::tie(row, column) < std::tie(first_nonfinite_row, first_nonfinite_column)) {
    first_nonfinite_row = row;
    first_nonfinite_column = column;
  }
}

void PixelTally::merge(const PixelTally& other) {
  for (int c = 0; c < kMaxChannels; ++c) see_extremes(c, other.minimum[c], other.maximum[c]);
  if (other.nonfinite_count > 0) {
    see_nonfinite(other.first_nonfinite_row, other.first_nonfinite_column);
    nonfinite_count += other.nonfinite_count - 1;
  }
  negative_count += other.negative_count;
  clamped_count += other.clamped_count;
}

void apply_pixel_policy(const PixelPolicy& policy, const PolicyRow& row, const ScanlinePlace& place,
                        PixelTally& tally, const OnClamp& on_clamp) {
  const std::size_t width = row.channels[0].size();
  const float limit = policy.clamp > 0.0 ? static_cast<float>(policy.clamp)
                                         : std::numeric_limits<float>::infinity();
  for (std::size_t j = 0; j < width; ++j) {
    bool nonfinite = false;
    bool negative = false;
    bool clamped = false;
    for (int c = 0; c < row.channel_count; ++c) {
      float& sample = row.channels[c][j];
      if (!std::isfinite(sample)) {
        nonfinite = true;
        sample = 0.0F;
        continue;
      }
      tally.see_extremes(c, sample, sample);
      if (sample < 0.0F) {
        negative = true;
        if (policy.negative == PixelPolicy::Negative::zero) sample = 0.0F;
      } else if (sample > limit) {
        clamped = true;
        on_clamp(c, j, static_cast<double>(sample) - static_cast<double>(limit));
        sample = limit;
      }
    }
    const auto steps = static_cast<std::int64_t>(j);
    if (nonfinite) {
      tally.see_nonfinite(place.row + steps * place.row_step,
                          place.column + steps * place.column_step);
    }
    tally.negative_count += negative ? 1 : 0;
    tally.clamped_count += clamped ? 1 : 0;
  }
}

}  // namespace shoal
