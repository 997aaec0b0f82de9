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

// NAME[.VARIANT].KIND[.LAYOUT][.SUFFIX], below maps/.
std::string map_stem(const Manifest& manifest, const PanoramaEntry& entry, const Variant& variant,
                     const MapRequest& map) {
  std::string stem = "maps/" + entry.name;
  if (manifest.variants.size() > 1) stem += "." + variant.name;
  stem += "." + kind_of(map);
  if (map.layout == MapLayout::cube) {
    stem += ".cube";
  } else if (map.layout != MapLayout::equirect) {
    stem += "." + std::string(name_of(layout_of(map)));
  }
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

// Two exports of any one panorama, and exports of a degree that a panorama has not.
void check_exports(const Manifest& manifest, ManifestLog& log) {
  PanoramaEntry any;
  any.name = "NAME";
  for (auto second = manifest.exports.begin(); second != manifest.exports.end(); ++second) {
    const std::string file = export_file(manifest, any, manifest.variants.front(), *second);
    for (auto first = manifest.exports.begin(); first != second; ++first) {
      if (file != export_file(manifest, any, manifest.variants.front(), *first)) continue;
      log.error(second->loc, fmt::format("two exports would be written to {}", in_quotes(file)),
                fmt::format("give one a suffix; the first is on line {}", first->loc.line));
      break;
    }
    const Status degree = check_export_degree(manifest, *second);
    if (!degree) log.error(second->loc, degree.error().what, degree.error().hint);
  }
}

std::vector<std::string> all_files(const Manifest& manifest, const PanoramaEntry& entry) {
  std::vector<std::string> all;
  if (entry.settings->picture) all.push_back(picture_file(entry).name);
  for (const Variant& variant : manifest.variants) {
    for (const MapRequest& map : manifest.maps) {
      for (std::string& file : map_files(manifest, entry, variant, map)) {
        all.push_back(std::move(file));
      }
    }
    for (const ExportRequest& request : manifest.exports) {
      all.push_back(export_file(manifest, entry, variant, request));
    }
  }
  return all;
}

// Files of two panoramas: "a.soft" in no variant and "a" in the variant soft. One name then is the
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
          common_file(all_files(manifest, *shorter->second), all_files(manifest, entry));
      if (file.empty()) continue;
      log.error(entry.origin->loc,
                fmt::format("files of the panoramas {} and {} would both be written to {}",
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

// Whether the linear keys of an entry and a variant make sense together.
Status check_linear(const EntrySettings& settings, const Variant& variant) {
  SHOAL_RETURN_IF_ERROR(combined_matrix(colour_of(settings, variant)));
  SHOAL_RETURN_IF_ERROR(turn_of(settings, variant));
  for (const AnalyticLight& light : settings.lights) SHOAL_RETURN_IF_ERROR(check_light(light));
  return {};
}

// A half ends at 65504, a sun shines with a million.
void check_picture(const PanoramaEntry& entry, ManifestLog& log) {
  const EntrySettings& settings = *entry.settings;
  if (!settings.picture || !settings.sky || settings.sky->disk != SunDisk::shown) return;
  const bool is_half =
      settings.picture->format == MapFileType::exr && settings.picture->samples == MapSamples::half;
  if (!is_half) return;
  log.warning(entry.origin->loc,
              fmt::format("the picture of {} loses its sun: a half ends at 65504, and the disk of "
                          "the sun is brighter",
                          in_quotes(entry.name)),
              "say type: float, or disk: hidden");
}

void check_linear_keys(const Manifest& manifest, ManifestLog& log) {
  const EntrySettings* checked = nullptr;
  const SourceLoc* told = nullptr;
  for (const PanoramaEntry& entry : manifest.entries) {
    if (entry.settings.get() == checked) continue;
    checked = entry.settings.get();
    check_picture(entry, log);
    const SourceLoc& loc = entry.origin->loc;
    for (const Variant& variant : manifest.variants) {
      const Status sound = check_linear(*entry.settings, variant);
      const bool is_told = told && told->file == loc.file && told->line == loc.line;
      if (sound || is_told) continue;
      log.error(loc, sound.error().what, sound.error().hint);
      told = &loc;
    }
  }
}

}  // namespace

void check_outputs(const Manifest& manifest, const SourceLoc& tables_loc, ManifestLog& log) {
  check_maps(manifest, log);
  check_exports(manifest, log);
  check_panoramas(manifest, log);
  check_tables(manifest, tables_loc, log);
  check_linear_keys(manifest, log);
}

Layout layout_of(const MapRequest& map) {
  switch (map.layout) {
    case MapLayout::equirect:
      break;
    case MapLayout::cube:
      return map.faces == CubeFaces::files ? Layout::cube_faces : Layout::cube_horizontal_strip;
    case MapLayout::cube_vertical_cross:
      return Layout::cube_vertical_cross;
    case MapLayout::cube_horizontal_cross:
      return Layout::cube_horizontal_cross;
    case MapLayout::cube_vertical_strip:
      return Layout::cube_vertical_strip;
    case MapLayout::cube_horizontal_strip:
      return Layout::cube_horizontal_strip;
    case MapLayout::angular:
      return Layout::angular;
    case MapLayout::mirror_ball:
      return Layout::mirror_ball;
    case MapLayout::octahedral:
      return Layout::octahedral;
    case MapLayout::octahedral_equal_area:
      return Layout::octahedral_equal_area;
    case MapLayout::cube_openexr:
      return Layout::cube_openexr;
  }
  return Layout::equirect;
}

bool has_faces_of_frame(const MapRequest& map) {
  return is_cube(layout_of(map)) && map.layout != MapLayout::cube_openexr;
}

std::vector<std::string> map_files(const Manifest& manifest, const PanoramaEntry& entry,
                                   const Variant& variant, const MapRequest& map) {
  const std::string stem = map_stem(manifest, entry, variant, map);
  const std::string end = "." + std::string(kExtensions[static_cast<int>(map.format)]);
  if (layout_of(map) != Layout::cube_faces) return {stem + end};
  std::vector<std::string> files;
  for (const std::string_view face : kCubeFaceNames) {
    files.push_back(fmt::format("{}.{}{}", stem, face, end));
  }
  return files;
}

}  // namespace shoal
