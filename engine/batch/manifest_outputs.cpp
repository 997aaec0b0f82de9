#include "batch/manifest_outputs.h"

#include <fmt/format.h>

#include <algorithm>
#include <string>
#include <unordered_map>
#include <utility>

namespace shoal {
namespace {

constexpr std::string_view kExtensions[] = {"exr", "hdr", "png"};  // by MapFileType

std::string kind_of(const MapRequest& map) {
  std::string kind(name_of(map.kind));
  std::replace(kind.begin(), kind.end(), '-', '_');
  return kind;
}

// NAME[.VARIANT].KIND[.cube][.SUFFIX], below maps/.
std::string map_stem(const Manifest& manifest, const PanoramaEntry& entry, const Variant& variant,
                     const MapRequest& map) {
  std::string stem = "maps/" + entry.name;
  if (manifest.variants.size() > 1) stem += "." + variant.name;
  stem += "." + kind_of(map);
  if (map.layout == MapLayout::cube) stem += ".cube";
  if (!map.suffix.empty()) stem += "." + map.suffix;
  return stem;
}

// The first file that is in both lists, or "".
std::string common_file(const std::vector<std::string>& a, const std::vector<std::string>& b) {
  const auto found = std::find_first_of(a.begin(), a.end(), b.begin(), b.end());
  return found == a.end() ? "" : *found;
}

// Two maps of any one panorama.
void check_maps(const Manifest& manifest, ManifestLog& log) {
  PanoramaEntry any;
  any.name = "NAME";
  const auto files = [&](const MapRequest& map) {
    return map_files(manifest, any, manifest.variants.front(), map);
  };
  for (auto second = manifest.maps.begin(); second != manifest.maps.end(); ++second) {
    for (auto first = manifest.maps.begin(); first != second; ++first) {
      const std::string file = common_file(files(*first), files(*second));
      if (file.empty()) continue;
      log.error(second->loc, fmt::format("two maps would be written to {}", in_quotes(file)),
                fmt::format("give one a suffix; the first is on line {}", first->loc.line));
      break;
    }
  }
}

std::vector<std::string> all_map_files(const Manifest& manifest, const PanoramaEntry& entry) {
  std::vector<std::string> all;
  for (const Variant& variant : manifest.variants) {
    for (const MapRequest& map : manifest.maps) {
      for (std::string& file : map_files(manifest, entry, variant, map)) {
        all.push_back(std::move(file));
      }
    }
  }
  return all;
}

// Maps of two panoramas: "a.soft" in no variant and "a" in the variant soft. One name then is the
// other with a dot behind it.
void check_panoramas(const Manifest& manifest, ManifestLog& log) {
  std::unordered_map<std::string_view, const PanoramaEntry*> by_name;
  for (const PanoramaEntry& entry : manifest.entries) by_name.emplace(entry.name, &entry);
  for (const PanoramaEntry& entry : manifest.entries) {
    const std::string_view name = entry.name;
    for (std::size_t dot = name.find('.'); dot != name.npos; dot = name.find('.', dot + 1)) {
      const auto shorter = by_name.find(name.substr(0, dot));
      if (shorter == by_name.end()) continue;
      const std::string file =
          common_file(all_map_files(manifest, *shorter->second), all_map_files(manifest, entry));
      if (file.empty()) continue;
      log.error(entry.origin->loc,
                fmt::format("maps of the panoramas {} and {} would both be written to {}",
                            in_quotes(shorter->first), in_quotes(name), in_quotes(file)),
                "give one of the panoramas another name");
    }
  }
}

void check_tables(const Manifest& manifest, const SourceLoc& loc, ManifestLog& log) {
  const auto& tables = manifest.tables;
  if (std::find(tables.begin(), tables.end(), TableFormat::npy) == tables.end()) return;
  const auto& entries = manifest.entries;
  const auto differs = std::find_if(entries.begin(), entries.end(), [&](const auto& entry) {
    return entry.settings->projection.degree != entries.front().settings->projection.degree;
  });
  if (differs == entries.end()) return;
  log.error(
      loc,
      fmt::format("an npy table has one degree, but {} has {} and {} has {}",
                  in_quotes(entries.front().name), entries.front().settings->projection.degree,
                  in_quotes(differs->name), differs->settings->projection.degree),
      "leave npy out, or use one degree");
}

void check_colours(const Manifest& manifest, ManifestLog& log) {
  const EntrySettings* checked = nullptr;
  const SourceLoc* told = nullptr;
  for (const PanoramaEntry& entry : manifest.entries) {
    if (entry.settings.get() == checked) continue;
    checked = entry.settings.get();
    const SourceLoc& loc = entry.origin->loc;
    for (const Variant& variant : manifest.variants) {
      const auto matrix = combined_matrix(colour_of(*entry.settings, variant));
      const bool is_told = told && told->file == loc.file && told->line == loc.line;
      if (matrix || is_told) continue;
      log.error(loc, matrix.error().what, matrix.error().hint);
      told = &loc;
    }
  }
}

}  // namespace

void check_outputs(const Manifest& manifest, const SourceLoc& tables_loc, ManifestLog& log) {
  check_maps(manifest, log);
  check_panoramas(manifest, log);
  check_tables(manifest, tables_loc, log);
  check_colours(manifest, log);
}

ColourOperations colour_of(const EntrySettings& settings, const Variant& variant) {
  const LinearKeys& base = settings.linear;
  const LinearKeys& over = variant.linear;
  ColourOperations colour;
  colour.exposure_stops = over.exposure_stops.value_or(base.exposure_stops.value_or(0.0));
  colour.scale = over.scale.value_or(base.scale.value_or(1.0));
  colour.matrix = over.matrix.value_or(base.matrix.value_or(glm::dmat3(1.0)));
  colour.white = over.white ? over.white : base.white;
  return colour;
}

Frame frame_of(const EntrySettings& settings, const Variant& variant) {
  return variant.linear.frame.value_or(settings.linear.frame.value_or(Frame{}));
}

std::vector<std::string> map_files(const Manifest& manifest, const PanoramaEntry& entry,
                                   const Variant& variant, const MapRequest& map) {
  const std::string stem = map_stem(manifest, entry, variant, map);
  const std::string end = "." + std::string(kExtensions[static_cast<int>(map.format)]);
  if (map.layout != MapLayout::cube || map.faces == CubeFaces::strip) return {stem + end};
  std::vector<std::string> files;
  for (const std::string_view face : kCubeFaceNames) {
    files.push_back(fmt::format("{}.{}{}", stem, face, end));
  }
  return files;
}

}  // namespace shoal
