// The plan of a run as a listing, for `check` and for `run --dry-run`.
#pragma once

#include "app/common_options.h"
#include "batch/plan.h"

namespace shoal {

[[nodiscard]] PlanOptions plan_options(const ManifestOptions& options);

// Makes the plan against the store, if there is one, and prints it on standard output. Returns the
// exit status. Writes nothing.
[[nodiscard]] int list_plan(const Manifest& manifest, const ManifestOptions& options);

}  // namespace shoal
