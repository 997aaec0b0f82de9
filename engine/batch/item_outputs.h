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

// Radiance of a variant in the native frame: white balance, matrix, scale and exposure applied.
// Error: usage (colour operations that make no sense).
Result<Coefficients> variant_radiance(const Projection& projection, const PanoramaEntry& entry,
                                      const Variant& variant);

// Writes all maps of a panorama. Returns what was written, in the manifest's order. Errors:
// write_failed, usage (as above), interrupted (`stop` is looked at before every map).
Result<std::vector<OutputRecord>> write_item_maps(const Manifest& manifest,
                                                  const PanoramaEntry& entry,
                                                  const Projection& projection,
                                                  const std::atomic<bool>& stop);

// Hands `take` the panorama's records for the tables, in their order, stopping at its first error.
Status make_item_records(const Manifest& manifest, const PanoramaEntry& entry,
                         const Projection& projection,
                         const std::function<Status(const CoefficientRecord&)>& take);

}  // namespace shoal
