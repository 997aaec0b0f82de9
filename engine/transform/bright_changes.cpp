#include "transform/bright_changes.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <numeric>
#include <tuple>
#include <utility>

namespace shoal {
namespace {

constexpr float kNoClamp = std::numeric_limits<float>::infinity();

double clamp_fraction(const PixelPolicy& policy) {
  return policy.clamp_percentile > 0.0 ? (100.0 - policy.clamp_percentile) / 100.0 : 0.0;
}

std::array<float, kMaxChannels> clamped(std::array<float, kMaxChannels> samples, float limit) {
  for (float& sample : samples) sample = std::min(sample, limit);
  return samples;
}

// Adds what a clamp does to a texel, or takes it back.
void tally_clamp(const std::array<float, kMaxChannels>& samples, float limit, double solid_angle,
                 int sign, BrightChanges& result) {
  if (std::ranges::max(samples) > limit) result.clamped_count += sign;
  for (int c = 0; c < kMaxChannels; ++c) {
    if (!(samples[c] > limit)) continue;
    result.clamped_flux[c] +=
        sign * solid_angle * (static_cast<double>(samples[c]) - static_cast<double>(limit));
  }
}

// The texels as the sun leaves them.
BrightestTexels without_sun(const BrightestTexels& bright, const SunSettings& settings,
                            const TexelPlaces& places, BrightChanges& result) {
  BrightestTexels rest = bright;
  if (!settings.asked()) return rest;
  Result<FoundSun> found = find_sun(bright, settings, places);
  if (!found) {
    result.warnings.push_back("no sun was found: " + found.error().what);
    return rest;
  }
  result.sun = found->sun;
  if (settings.action == SunSettings::Action::keep) return rest;
  for (const std::size_t i : found->members) {
    rest.texels[i] = lowered(rest.texels[i], static_cast<float>(found->sun.level));
  }
  return rest;
}

// BrightestTexels::threshold() of texels that a sun has left in another order.
float threshold_of(const BrightestTexels& bright, double fraction) {
  std::vector<std::size_t> order(bright.texels.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::ranges::stable_sort(order, std::greater(),
                           [&](std::size_t i) { return bright.texels[i].value(); });
  BrightestTexels sorted;
  for (const std::size_t i : order) {
    sorted.texels.push_back(bright.texels[i]);
    sorted.solid_angles.push_back(bright.solid_angles[i]);
  }
  return sorted.threshold(fraction);
}

float late_limit(const BrightestTexels& rest, const PixelPolicy& policy, BrightChanges& result) {
  if (policy.clamp_percentile <= 0.0) return kNoClamp;
  const float limit = threshold_of(rest, clamp_fraction(policy));
  if (limit > 0.0F) {
    result.clamp = limit;
    return limit;
  }
  result.warnings.push_back(
      fmt::format("nothing was clamped: {:g} % of the sphere are black", policy.clamp_percentile));
  return kNoClamp;
}

}  // namespace

BrightRange bright_range(const ProjectionSettings& settings) {
  const SunSettings& sun = settings.sun;
  const double clamp = clamp_fraction(settings.pixels);
  if (sun.above > 0.0) {
    return {kMostBright, clamp > 0.0 ? 0.0F : static_cast<float>(sun.above)};
  }
  return {std::max(clamp, sun.top), 0.0F};
}

BrightChanges bright_changes(const BrightestTexels& bright, const ProjectionSettings& settings,
                             const TexelPlaces& places) {
  BrightChanges result;
  const BrightestTexels rest = without_sun(bright, settings.sun, places, result);
  const PixelPolicy& policy = settings.pixels;
  // The limit that the sums know already, and the one that they don't.
  const float early = policy.clamp > 0.0 ? static_cast<float>(policy.clamp) : kNoClamp;
  const float late = late_limit(rest, policy, result);
  for (std::size_t i = 0; i < rest.texels.size(); ++i) {
    const BrightTexel& texel = rest.texels[i];
    const auto& seen = bright.texels[i].samples;
    const auto before = clamped(seen, early);
    const auto after = clamped(texel.samples, std::min(early, late));
    if (before == after && texel.samples == seen) continue;
    if (before != after) result.changes.push_back({texel.row, texel.column, before, after});
    tally_clamp(seen, early, bright.solid_angles[i], -1, result);
    tally_clamp(texel.samples, std::min(early, late), bright.solid_angles[i], 1, result);
  }
  std::ranges::sort(result.changes, {},
                    [](const TexelChange& change) { return std::pair(change.row, change.column); });
  return result;
}

}  // namespace shoal
