// Pixels of skies and lights, which no file holds: shoal paints them anew from what the store says
// that they were projected from.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "core/result.h"
#include "library/pixels.h"

namespace shoal::viz {

// The sky or the lights of an entry without a file, as its keys in a manifest, from the store's
// `parameters` of it. Empty for a panorama with a file, and where the text is another's.
[[nodiscard]] std::string recipe_of(const std::string& parameters);

// Pictures of `width` x width/2 texels, in the order asked for, by one run of `shoal run`; an Error
// for those that cannot be painted. Precondition: width >= 2.
[[nodiscard]] std::vector<Result<Pixels>> paint(std::span<const std::string> recipes, int width);

}  // namespace shoal::viz
