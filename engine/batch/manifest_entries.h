// From the entries of a manifest to panoramas: files found, names given and checked.
#pragma once

#include <filesystem>
#include <vector>

#include "batch/manifest_keys.h"

namespace shoal {

// The panoramas of `entries` in their order, those of a pattern in bytewise order of their paths.
// What lies in the maps or exports folder of `output` is no panorama for a pattern: a second run
// must not take the first one's maps for its input.
[[nodiscard]] std::vector<PanoramaEntry> find_panoramas(const std::vector<EntryText>& entries,
                                                        const std::filesystem::path& output,
                                                        ManifestLog& log);

}  // namespace shoal
