// Panoramas straight from their files.
#pragma once

#include <filesystem>
#include <vector>

#include "core/result.h"
#include "library/library.h"

namespace shoal::viz {

// The pictures of high dynamic range in the folder and below, in bytewise order of their paths.
[[nodiscard]] Result<std::vector<std::filesystem::path>> pictures_below(
    const std::filesystem::path& folder);

// Projects the files with one run of `shoal project`. Panoramas are named by their file names
// without extension, or by their paths where these would meet. A file that cannot be projected is
// among the failed. Errors: not_found (shoal), unreadable.
[[nodiscard]] Result<Library> project_files(const std::vector<std::filesystem::path>& files,
                                            const LoadSettings& settings);

}  // namespace shoal::viz
