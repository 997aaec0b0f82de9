// Where pictures go: one file, or one of each panorama or page.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "core/result.h"

namespace shoal::viz {

enum class OutputFormat { png, vtp, gltf, glb };

// The format that --format or the extension of -o says; png for a folder.
// Errors: usage (an extension of none, or another one than --format says).
[[nodiscard]] Result<OutputFormat> output_format(const std::string& output,
                                                 const std::string& format);

// A file for each of `names`: with {name} or {page} replaced, or DIR/NAME.EXT where the output ends
// in '/' or is a folder. Slashes in a name make folders; none leads out of the output's. Errors:
// usage (several names and nothing that tells them apart, or two that give one file).
[[nodiscard]] Result<std::vector<std::filesystem::path>> output_files(
    const std::string& output, OutputFormat format, std::string_view placeholder,
    const std::vector<std::string>& names);

}  // namespace shoal::viz
