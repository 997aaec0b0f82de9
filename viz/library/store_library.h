// The store of `shoal run` as a library.
#pragma once

#include <filesystem>

#include "core/result.h"
#include "library/library.h"

namespace shoal::viz {

// What shoal calls its store in an output folder.
inline constexpr std::string_view kStoreName = "shoal.db";

// The panoramas of the store, and as further ones the variants that the tables beside it tell, in
// the order of the tables, by name where there is none.
// Errors: malformed (damaged, or another program's), unsupported (another version's), unreadable.
[[nodiscard]] Result<Library> load_store(const std::filesystem::path& store);

}  // namespace shoal::viz
