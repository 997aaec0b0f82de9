// What a run writes of one panorama, from its projection: everything that waited for the
// coefficients.
#pragma once

#include <atomic>
#include <functional>
#include <vector>

#include "batch/manifest.h"
#include "batch/store.h"
#include "core/result.h"
#include "output/coefficient_table.h"
#include "sphere/coefficients.h"
#include "transform/projector.h"

namespace shoal {

// Writes the picture, all maps and exports of a panorama. Returns what was written, in the
// manifest's order. Errors: write_failed, usage (as variant_light), interrupted (`stop` is looked
// at before every file).
Result<std::vector<OutputRecord>> write_item_outputs(const Manifest& manifest,
                                                     const PanoramaEntry& entry,
                                                     const Projection& projection,
                                                     const std::atomic<bool>& stop);

// The figures of quality of all variants, or none where they are not wanted. Errors: as
// variant_light.
Result<std::vector<VariantQuality>> item_quality(const Manifest& manifest,
                                                 const PanoramaEntry& entry,
                                                 const Projection& projection);

// Hands `take` the panorama's records for the tables, in their order, stopping at its first error.
Status make_item_records(const Manifest& manifest, const PanoramaEntry& entry,
                         const Projection& projection,
                         const std::function<Status(const CoefficientRecord&)>& take);

}  // namespace shoal
