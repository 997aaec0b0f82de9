// The tables of a run, made from the store: so they hold what earlier runs did as well.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "batch/manifest.h"
#include "batch/store.h"
#include "core/result.h"

namespace shoal {

struct RunTables {
  std::vector<std::string> paths;
  std::int64_t missing_count =
      0;  // entries of the manifest whose projection the store does not have
};

// Writes the tables that the manifest asks for, unless those that stand were made from the same.
// Entries that failed, or whose parameters have changed since they were projected, are left out.
Result<RunTables> write_run_tables(const Manifest& manifest, Store& store);

}  // namespace shoal
