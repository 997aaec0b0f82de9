// What becomes of a panorama's brightest texels once all of it has been seen: its sun, and the
// clamp by percentile.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "transform/bright_texels.h"
#include "transform/picture_sums.h"
#include "transform/projection_settings.h"
#include "transform/sun_light.h"

namespace shoal {

// How many of a picture's brightest texels its settings ask for, and above which value.
struct BrightRange {
  double fraction = 0.0;  // 0: none
  float floor = 0.0F;
};
[[nodiscard]] BrightRange bright_range(const ProjectionSettings& settings);

struct BrightChanges {
  std::vector<TexelChange> changes;  // by row, then column
  std::optional<Sun> sun;            // in the file's own colours, without its share
  double clamp = 0.0;                // the value that samples were clamped to; 0: none
  // What changes of the tally of clamped pixels and of the flux that the clamp took.
  std::int64_t clamped_count = 0;
  std::array<double, kMaxChannels> clamped_flux{};
  std::vector<std::string> warnings;
};

// The sun is what it is before the clamp; then what is left of the picture is clamped.
// The samples of `bright` are those before a clamp by value, which the sums have seen already.
[[nodiscard]] BrightChanges bright_changes(const BrightestTexels& bright,
                                           const ProjectionSettings& settings,
                                           const TexelPlaces& places);

}  // namespace shoal
