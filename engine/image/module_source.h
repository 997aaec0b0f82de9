// Pictures that only OpenImageIO reads (PFM, TIFF, PNG, JPEG, DDS, ...), through a module that is
// loaded when the first of them comes.
#pragma once

#include <filesystem>
#include <memory>
#include <vector>

#include "core/result.h"
#include "image/panorama_source.h"

namespace shoal {

// Bands are float planes, linear: integers are taken as sRGB unless options.encoding says
// otherwise. Alpha is ignored. Bands must be read in order. Errors: not_found, unreadable,
// malformed; unsupported also when the module is not installed.
Result<std::unique_ptr<PanoramaSource>> open_with_module(const std::filesystem::path& path,
                                                         const ReadOptions& options);

// Where the module is looked for, in this order: the folders of the environment variable
// SHOAL_MODULE_PATH (separated by ':'), the executable's own folder (a build tree), and the library
// folder that an installed executable belongs to.
[[nodiscard]] std::vector<std::filesystem::path> module_search_path();

}  // namespace shoal
