// The files that a panorama is read from: one, or the six of a cube's faces, of which an entry
// names one.
#pragma once

#include <filesystem>
#include <string>

#include "batch/manifest.h"
#include "batch/store.h"
#include "core/result.h"
#include "sphere/layout.h"

namespace shoal {

// Size and modification time of an entry's file, without its hash; of six files their sums, which
// change when one of them does. Errors: input_state()'s.
Result<InputState> entry_state(const PanoramaEntry& entry);

// Whether the entry is read from one file, so that its content can be hashed as it is read.
[[nodiscard]] bool is_one_file(const PanoramaEntry& entry);

// The hash of the content of the panorama that `path` names in the layout: hash_file()'s, or where
// there are six files that of their hashes. Errors: hash_file()'s.
Result<std::string> hash_panorama(const std::filesystem::path& path, Layout layout);

}  // namespace shoal
