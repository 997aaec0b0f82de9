// Pictures that only OpenImageIO reads (PFM, TIFF, PNG, JPEG, DDS, ...), through a module that is
// loaded when the first of them comes.
#pragma once

#include <filesystem>
#include <memory>

#include "core/result.h"
#include "image/panorama_source.h"

namespace shoal {

// Bands are float planes, linear: integers are taken as sRGB unless options.encoding says
// otherwise. Alpha is ignored. Bands must be read in order. Errors: not_found, unreadable,
// malformed; unsupported also when the module is not installed.
Result<std::unique_ptr<PanoramaSource>> open_with_module(const std::filesystem::path& path,
                                                         const ReadOptions& options);

}  // namespace shoal
