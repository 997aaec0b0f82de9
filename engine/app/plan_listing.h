// The plan of a run, and its listing for `check` and for `run --dry-run`. Writes nothing.
#pragma once

#include <string>

#include "app/common_options.h"
#include "batch/plan.h"

namespace shoal {

// Against the store, if there is one. Errors: as make_plan().
Result<Plan> plan_against_store(const Manifest& manifest, const ManifestOptions& options);

// Why an item runs, or not, and its layout where that is known, before its file is opened, to be
// other than equirect: "new, cube-faces".
[[nodiscard]] std::string reason_of(const PlannedItem& item);

// Makes the plan and prints it on standard output. Returns the exit status.
[[nodiscard]] int list_plan(const Manifest& manifest, const ManifestOptions& options);

}  // namespace shoal
