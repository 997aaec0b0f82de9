#include "app/common_options.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <iterator>
#include <set>
#include <string_view>
#include <utility>

#include "app/messages.h"
#include "app/scene_options.h"
#include "core/diagnostic.h"

namespace shoal::viz {
namespace {

constexpr std::size_t kMaxNamesTold = 8;
constexpr int kMinSide = 64;
constexpr int kMaxSide = 8192;
constexpr int kMaxGrid = 50;
constexpr double kMaxStops = 100.0;

// Each text once, in their order; the first few of many.
std::string listed(const std::vector<std::string>& texts) {
  std::vector<std::string> distinct;
  std::set<std::string> known;
  for (const std::string& text : texts) {
    if (known.insert(text).second) distinct.push_back(text);
  }
  const std::size_t told = std::min(distinct.size(), kMaxNamesTold);
  std::string list = fmt::format("{}", fmt::join(distinct.begin(), distinct.begin() + told, ", "));
  if (distinct.size() > told) list += fmt::format(" and {} more", distinct.size() - told);
  return list;
}

// What was probably meant by a pattern that chooses nothing: the nearest name, or those that it is
// a part of; else empty.
std::string meant_by(const std::string& pattern, const Library& library) {
  std::set<std::string> names;
  for (const Panorama& panorama : library.panoramas) {
    names.insert({panorama.name, variant_name(panorama)});
  }
  const std::vector<std::string_view> candidates(names.begin(), names.end());
  const std::string_view near = closest_match(pattern, candidates);
  if (!near.empty() || pattern.empty()) return std::string(near);
  const std::string around =
      (pattern.starts_with('*') ? "" : "*") + pattern + (pattern.ends_with('*') ? "" : "*");
  return find_panoramas(library, around).empty() ? "" : around;
}

Error nothing_like(const std::string& pattern, const Library& library) {
  const auto failed = std::ranges::find(library.failed, pattern, &FailedPanorama::name);
  if (failed != library.failed.end()) {
    return Error{ErrorCode::not_found, "has failed: " + failed->error, pattern, ""};
  }
  std::vector<std::string> names;
  std::vector<std::string> variants;
  for (const Panorama& panorama : library.panoramas) {
    names.push_back(panorama.name);
    variants.push_back(variant_of(panorama));
  }
  const std::string meant = meant_by(pattern, library);
  std::string hint = meant.empty() ? "" : fmt::format("did you mean \"{}\"? ", meant);
  hint += "the names are " + listed(names);
  if (std::ranges::count(variants, variants.front()) < std::ssize(variants)) {
    hint += "; the variants are " + listed(variants);
  }
  return Error{ErrorCode::usage, fmt::format("no panorama is named like \"{}\"", pattern), "",
               std::move(hint)};
}

// "640x480", each within [low, high].
Result<std::pair<int, int>> parse_pair(const std::string& option, const std::string& text, int low,
                                       int high, const std::string& example) {
  std::pair<int, int> pair;
  const char* end = text.data() + text.size();
  const auto first = std::from_chars(text.data(), end, pair.first);
  const bool has_x = first.ec == std::errc() && first.ptr != end && *first.ptr == 'x';
  const auto second = has_x ? std::from_chars(first.ptr + 1, end, pair.second) : first;
  const auto within = [&](int value) { return value >= low && value <= high; };
  if (has_x && second.ec == std::errc() && second.ptr == end && within(pair.first) &&
      within(pair.second)) {
    return pair;
  }
  return Error{ErrorCode::usage,
               fmt::format("{} {} is not two numbers from {} to {} with an x between", option, text,
                           low, high),
               "", "such as " + example};
}

Status check_exposure(double stops) {
  if (std::abs(stops) <= kMaxStops) return {};  // not a number is not
  return Error{
      ErrorCode::usage,
      fmt::format("--exposure {} is not from -{} to {} stops", stops, kMaxStops, kMaxStops), "",
      "each stop doubles the light that is shown"};
}

Channel channel_of(const std::string& name) {
  if (name == "red") return Channel::red;
  if (name == "green") return Channel::green;
  return name == "blue" ? Channel::blue : Channel::luminance;
}

std::string scene_names() {
  std::string names;
  for (const SceneKind kind : kAllScenes) {
    names += (names.empty() ? "" : ", ") + std::string(name_of(kind));
  }
  return names;
}

}  // namespace

void add_library_options(CLI::App& command, LibraryOptions& options, Sources sources) {
  auto* out = command.add_option(
      "OUT", options.sources,
      "Output folder of `shoal run`; or a store, a table, panoramas or folders of them");
  out->required(sources == Sources::needed);
  command.add_option("--panorama", options.panorama,
                     "Only panoramas whose name is like this glob, in all their variants, or "
                     "variants whose NAME.VARIANT is, such as sunset.plain or '*.soft'");
  command
      .add_option("--degree", options.degree,
                  "Highest degree that is shown; of panoramas that are projected for it, 2 by "
                  "default")
      ->check(CLI::Range(0, kMaxDegree));
  command.add_option("--table-frame", options.table_frame,
                     "Frame of CSV tables that nothing beside them tells, as in --frame; native by "
                     "default");
}

Result<Library> load(const LibraryOptions& options) {
  LoadSettings settings;
  settings.degree = options.degree;
  if (!options.table_frame.empty()) {
    SHOAL_ASSIGN_OR_RETURN(frame, parse_frame(options.table_frame));
    settings.table_frame = frame;
  }
  const std::vector<std::filesystem::path> sources(options.sources.begin(), options.sources.end());
  SHOAL_ASSIGN_OR_RETURN(library, load_library(sources, settings));
  if (options.table_frame.empty()) {
    print_frameless(library);
  } else if (library.frameless.empty()) {
    return Error{ErrorCode::usage, "--table-frame has no effect", "",
                 "all that is looked at tells its frame; --frame names the one that is drawn"};
  }
  print_failed(library);
  if (options.degree) {
    print_lesser_degrees(part_of(library, find_panoramas(library, options.panorama)),
                         *options.degree);
  }
  if (!library.panoramas.empty()) return library;
  return Error{ErrorCode::not_found, "there is no panorama to look at", options.sources.front(),
               library.failed.empty() ? "run `shoal run MANIFEST` first" : "all of them failed"};
}

Result<std::vector<std::size_t>> select(const Library& library, const std::string& pattern) {
  std::vector<std::size_t> found = find_panoramas(library, pattern);
  if (!found.empty()) return found;
  return nothing_like(pattern, library);
}

Result<Library> load_selected(const LibraryOptions& options) {
  SHOAL_ASSIGN_OR_RETURN(library, load(options));
  SHOAL_ASSIGN_OR_RETURN(selected, select(library, options.panorama));
  return part_of(library, selected);
}

void add_scene_options(CLI::App& command, SceneOptions& options) {
  command.add_option("--scene", options.scene, scene_names() + "; lobes by default");
  command.add_option("--frame", options.frame,
                     scene_help("--frame",
                                "Frame whose axes are drawn: a name, or where the panorama's "
                                "centre, right and up point, such as +z,-x,+y; that of the "
                                "library's tables by default"));
  command.add_option("--quantity", options.quantity,
                     scene_help("--quantity", "radiance, irradiance or irradiance-over-pi"));
  command
      .add_option("--channel", options.channel,
                  scene_help("--channel", "luminance, red, green or blue"))
      ->check(CLI::IsMember({"luminance", "red", "green", "blue"}));
  command
      .add_option("--colour", options.colour,
                  scene_help("--colour", "Lobes in the colours of their sign or the light"))
      ->check(CLI::IsMember({"sign", "light"}));
  command.add_option("--exposure", options.exposure_stops,
                     scene_help("--exposure", "Stops on top of the automatic exposure"));
  command.add_option("--size", options.size, "Width and height in pixels, 1280x720 by default");
  command.add_option("--grid", options.grid,
                     scene_help("--grid",
                                "Columns and rows of a page, such as 5x4; by default those that "
                                "suit the library, 20 panoramas a page at most"));
  command.add_option("--with", options.with,
                     scene_help("--with",
                                "The panorama to compare with, as in --panorama; NAME.VARIANT "
                                "where it has several variants"));
}

Result<std::optional<std::size_t>> select_other(const Library& library, const std::string& with) {
  if (with.empty()) return std::optional<std::size_t>();
  SHOAL_ASSIGN_OR_RETURN(found, select(library, with));
  if (found.size() == 1) return std::optional<std::size_t>(found.front());
  const Panorama& first = library.panoramas[found.front()];
  const bool is_alone = find_panoramas(library, first.name).size() == 1;
  return Error{ErrorCode::usage,
               fmt::format("--with {} names {}", with, count_text(part_of(library, found))), "",
               fmt::format("name one, such as {}", is_alone ? first.name : variant_name(first))};
}

Result<SceneChoice> understand(const SceneOptions& options, const std::optional<int>& degree) {
  SceneChoice choice;
  SHOAL_ASSIGN_OR_RETURN(scene, parse_scene(options.scene));
  SHOAL_ASSIGN_OR_RETURN(quantity, parse_quantity(options.quantity));
  SHOAL_ASSIGN_OR_RETURN(size, parse_pair("--size", options.size, kMinSide, kMaxSide, "1280x720"));
  choice.scene = scene;
  choice.size = {size.first, size.second};
  SceneSettings& settings = choice.settings;
  if (!options.frame.empty()) {
    SHOAL_ASSIGN_OR_RETURN(frame, parse_frame(options.frame));
    settings.frame = frame;
  }
  settings.degree = degree;
  settings.quantity = quantity;
  settings.channel = channel_of(options.channel);
  settings.colour = options.colour == "light" ? LobeColour::light : LobeColour::sign;
  SHOAL_RETURN_IF_ERROR(check_exposure(options.exposure_stops));
  settings.exposure_stops = options.exposure_stops;
  if (!options.grid.empty()) {
    SHOAL_ASSIGN_OR_RETURN(grid, parse_pair("--grid", options.grid, 1, kMaxGrid, "5x4"));
    settings.grid = Grid{grid.first, grid.second};
  }
  return choice;
}

}  // namespace shoal::viz
