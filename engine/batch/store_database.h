// The database of a store: made, recognised, and set up.
#pragma once

#include <filesystem>

#include "batch/sqlite.h"
#include "batch/store.h"
#include "core/result.h"

namespace shoal {

// Opens a database that has this version's schema; the errors are those of Store::open().
Result<SqlDatabase> open_store_database(const std::filesystem::path& path, Store::Access access);

}  // namespace shoal
