// A first manifest for a folder of panoramas.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "core/result.h"

namespace shoal {

inline constexpr std::string_view kInitialManifestName = "shoal.yaml";

// The text of a commented manifest that takes the panoramas in `folder` and below, and runs as it
// is when it lies in that folder as kInitialManifestName. Pictures of low dynamic range count only
// where there are no others, since previews and contact sheets lie beside panoramas.
// Errors: not_found, for a folder that is none or holds no pictures; unreadable.
[[nodiscard]] Result<std::string> initial_manifest(const std::filesystem::path& folder);

}  // namespace shoal
