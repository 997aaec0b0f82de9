// The plan of a run, and its listing for `check` and for `run --dry-run`. Writes nothing.
#pragma once

#include "app/common_options.h"
#include "batch/plan.h"

namespace shoal {

// Against the store, if there is one. Errors: as make_plan().
Result<Plan> plan_against_store(const Manifest& manifest, const ManifestOptions& options);

// Makes the plan and prints it on standard output. Returns the exit status.
[[nodiscard]] int list_plan(const Manifest& manifest, const ManifestOptions& options);

}  // namespace shoal
