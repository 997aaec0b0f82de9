// EXR parts that need OpenEXR's C++ classes: DWAA and DWAB, where the C library does them slowly or
// not at all, parts with subsampled channels beside the colour, and luminance/chroma, which becomes
// half R, G, B, with the library's reconstruction filter. The classes live in a module that is
// loaded when the first such part comes.
//
// Every reader opens the file's header for itself, so that readers do not wait for each other.
#pragma once

#include <memory>

#include "core/result.h"
#include "image/exr_band_reader.h"

namespace shoal {

// Planar rows, in the file's own sample type but for luminance/chroma. Errors: malformed;
// unsupported where the module is not installed.
Result<std::unique_ptr<BandReader>> new_exr_imf_reader(std::shared_ptr<const ExrPicture> picture);

}  // namespace shoal
