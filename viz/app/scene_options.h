// In which scenes an option counts.
#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <string_view>

#include "core/result.h"
#include "scenes/scene.h"

namespace shoal::viz {

// The help of an option that counts in some scenes, with these behind it: "TEXT; in contact".
[[nodiscard]] std::string scene_help(std::string_view option, const std::string& text);

// Error: usage, where the command line has an option that makes no difference to the scene.
[[nodiscard]] Status expect_effect(const CLI::App& command, SceneKind scene);

}  // namespace shoal::viz
