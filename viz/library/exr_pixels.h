// Pictures that shoal writes for the viewer.
#pragma once

#include <filesystem>

#include "core/result.h"
#include "library/pixels.h"

namespace shoal::viz {

// R, G and B of an OpenEXR file that shoal wrote. Error: unreadable.
[[nodiscard]] Result<Pixels> read_exr(const std::filesystem::path& path);

}  // namespace shoal::viz
