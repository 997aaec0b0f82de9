// What a manifest does to the light of its panoramas' pixels, for those who show both.
#pragma once

#include <vector>

#include "batch/manifest.h"
#include "batch/store.h"
#include "core/result.h"

namespace shoal {

// Of every panorama and variant that is not told in the native frame, or whose light is not that of
// its pixels. Errors: usage (linear keys that make no sense).
Result<std::vector<VariantFacts>> variant_facts(const Manifest& manifest);

}  // namespace shoal
