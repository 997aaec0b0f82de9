// Options that several commands share.
#pragma once

#include <CLI/CLI.hpp>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "core/result.h"
#include "library/library.h"
#include "scenes/scene.h"
#include "window/offscreen.h"

namespace shoal::viz {

// What to look at.
struct LibraryOptions {
  std::vector<std::string> sources;
  std::string panorama = "*";
  std::optional<int> degree;
  std::string table_frame;
};

enum class Sources { needed, optional };
void add_library_options(CLI::App& command, LibraryOptions& options, Sources sources);

// The library, of which no more than the panoramas that are left out has been told. Errors: those
// of load_library(); usage; not_found, where it has no panorama.
[[nodiscard]] Result<Library> load(const LibraryOptions& options);

// The panoramas that a pattern matches. Errors: usage, with the names that there are; not_found, of
// one that failed.
[[nodiscard]] Result<std::vector<std::size_t>> select(const Library& library,
                                                      const std::string& pattern);

// The library with no more than the panoramas that --panorama selects. Errors: those of load() and
// select().
[[nodiscard]] Result<Library> load_selected(const LibraryOptions& options);

// How to look at it.
struct SceneOptions {
  std::string scene = "lobes";
  std::string frame;
  std::string quantity = "radiance";
  std::string channel = "luminance";
  std::string colour = "sign";
  double exposure_stops = 0.0;
  std::string size = "1280x720";
  std::string grid;
  std::string with;
};

void add_scene_options(CLI::App& command, SceneOptions& options);

// The one panorama that --with names; nothing where it is not given. Error: usage.
[[nodiscard]] Result<std::optional<std::size_t>> select_other(const Library& library,
                                                              const std::string& with);

// The same, understood.
struct SceneChoice {
  SceneKind scene = SceneKind::lobes;
  SceneSettings settings;
  PictureSize size;
};

// Errors: usage.
[[nodiscard]] Result<SceneChoice> understand(const SceneOptions& options,
                                             const std::optional<int>& degree);

}  // namespace shoal::viz
