#include "app/scene_options.h"

#include <fmt/format.h>

#include <algorithm>
#include <initializer_list>
#include <vector>

namespace shoal::viz {
namespace {

using enum SceneKind;

struct SceneOption {
  std::string_view name;
  std::initializer_list<SceneKind> scenes;            // in which it counts
  std::initializer_list<SceneKind> beside_with = {};  // and where it does together with --with
};

// All other options count everywhere: --degree in lit, too, to which panoramas are projected.
constexpr SceneOption kSceneOptions[] = {
    {"--panorama", {lobes, sphere, degrees, lit, compare, contact}},
    {"--frame", {basis, lobes, sphere, degrees, lit, contact}},
    {"--quantity", {lobes, degrees, contact}, {compare}},  // pixels are radiance
    {"--channel", {lobes, degrees, compare, contact}},
    {"--colour", {lobes, contact}},
    {"--exposure", {lobes, sphere, lit, compare, contact}},
    {"--grid", {contact}},
    {"--page", {contact}},
    {"--with", {compare}},
};

bool has(const std::initializer_list<SceneKind>& scenes, SceneKind scene) {
  return std::ranges::find(scenes, scene) != scenes.end();
}

// "lobes, degrees, compare --with"
std::string scenes_of(const SceneOption& option) {
  std::vector<std::string> names;
  for (const SceneKind scene : option.scenes) names.emplace_back(name_of(scene));
  for (const SceneKind scene : option.beside_with) {
    names.push_back(fmt::format("{} --with", name_of(scene)));
  }
  return fmt::format("{}", fmt::join(names, ", "));
}

}  // namespace

std::string scene_help(std::string_view option, const std::string& text) {
  const auto* found = std::ranges::find(kSceneOptions, option, &SceneOption::name);
  return fmt::format("{}; in {}", text, scenes_of(*found));
}

Status expect_effect(const CLI::App& command, SceneKind scene) {
  const bool has_other = command.count("--with") > 0;
  for (const SceneOption& option : kSceneOptions) {
    const bool counts = has(option.scenes, scene) || (has_other && has(option.beside_with, scene));
    if (counts || command.count(std::string(option.name)) == 0) continue;
    return Error{ErrorCode::usage,
                 fmt::format("{} has no effect in the scene {}", option.name, name_of(scene)), "",
                 "it counts in " + scenes_of(option)};
  }
  return {};
}

}  // namespace shoal::viz
