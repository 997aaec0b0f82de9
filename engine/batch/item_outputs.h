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

struct ItemResults {
  std::vector<OutputRecord> outputs;    // the files written, in the manifest's order
  std::vector<VariantQuality> quality;  // of all variants, or none where figures are not wanted
};

// Writes the picture, all maps and exports of a panorama, and finds its figures of quality.
// Errors: write_failed, usage (as VariantLights), interrupted (`stop` is looked at before every
// file).
Result<ItemResults> make_item_results(const Manifest& manifest, const PanoramaEntry& entry,
                                      const Projection& projection, const std::atomic<bool>& stop);

// The figures alone.
Result<std::vector<VariantQuality>> item_quality(const Manifest& manifest,
                                                 const PanoramaEntry& entry,
                                                 const Projection& projection);

// Hands `take` the panorama's records for the tables, in their order, stopping at its first error.
Status make_item_records(const Manifest& manifest, const PanoramaEntry& entry,
                         const Projection& projection,
                         const std::function<Status(const CoefficientRecord&)>& take);

}  // namespace shoal
