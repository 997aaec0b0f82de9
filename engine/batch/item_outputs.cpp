#include "batch/item_outputs.h"

#include <fmt/format.h>

#include <utility>

#include "batch/painted_light.h"
#include "batch/variant_light.h"
#include "core/atomic_file.h"
#include "core/content_hash.h"
#include "transform/map_synthesis.h"

namespace shoal {
namespace {

MapFormat map_format(const MapRequest& map) {
  switch (map.format) {
    case MapFileType::hdr:
      return MapFormat::hdr;
    case MapFileType::png:
      return MapFormat::png;
    case MapFileType::exr:
      break;
  }
  return map.samples == MapSamples::half ? MapFormat::exr_half : MapFormat::exr_float;
}

MapFile map_file(const PanoramaEntry& entry, const Variant& variant, const MapRequest& map,
                 const Projection& projection, const Frame& frame) {
  MapFile file;
  file.format = map_format(map);
  const Layout layout = layout_of(map);
  file.width = map.width;
  file.height = map.height;
  if (layout != Layout::equirect && layout != Layout::cube_faces) {
    const LayoutSize size = size_of(layout, map.width);
    file.width = size.width;
    file.height = size.height;
  }
  file.preview_exposure = map.preview_stops;
  file.attributes = {
      {"shoal:panorama", entry.name},
      {"shoal:variant", variant.name},
      {"shoal:quantity", std::string(name_of(map.kind))},
      {"shoal:degree", std::to_string(projection.radiance.degree)},
      {"shoal:quadrature", std::string(name_of(projection.quadrature))},
  };
  if (layout != Layout::equirect) {
    file.attributes.emplace_back("shoal:layout", std::string(name_of(layout)));
  }
  if (has_faces_of_frame(map)) file.attributes.emplace_back("shoal:frame", text_of(frame));
  return file;
}

// One map: one file, or six.
Status write_map_files(const Manifest& manifest, const MapRequest& map, const MapFile& file,
                       const Coefficients& native, const Frame& frame,
                       const std::vector<std::string>& names) {
  if (map.layout == MapLayout::equirect) {
    return write_equirect_map(native, manifest.output / names.front(), file);
  }
  const Layout layout = layout_of(map);
  const Coefficients light = has_faces_of_frame(map) ? facing(native, frame) : native;
  for (std::size_t face = 0; face < names.size(); ++face) {
    SHOAL_RETURN_IF_ERROR(write_layout_map(light, layout, static_cast<int>(face),
                                           manifest.output / names[face], file));
  }
  return {};
}

// Of the panorama's light in a variant.
Result<OutputRecord> write_export(const Manifest& manifest, const PanoramaEntry& entry,
                                  const Variant& variant, const ExportRequest& request,
                                  const Coefficients& radiance) {
  const Profile& profile = *request.profile;
  const bool one_variant = manifest.variants.size() == 1;
  SHOAL_ASSIGN_OR_RETURN(
      text, write_profile_text(profile, radiance, {entry.name, one_variant ? "" : variant.name}));
  const std::string name = export_file(manifest, entry, variant, request);
  SHOAL_RETURN_IF_ERROR(write_file_atomically(manifest.output / name, text));
  return OutputRecord{name, "export:" + profile.name, hash_text(text), text.size()};
}

Result<OutputRecord> output_record(const Manifest& manifest, const std::string& name,
                                   const MapRequest& map) {
  const std::filesystem::path path = manifest.output / name;
  SHOAL_ASSIGN_OR_RETURN(hash, hash_file(path));
  std::error_code ignored;
  return OutputRecord{name, "map:" + std::string(name_of(map.kind)), hash,
                      std::filesystem::file_size(path, ignored)};
}

// Whose axes name the faces of a cube: without a frame in the manifest those that cubes are read in,
// since the native up, +z, is no cube's.
Frame frame_of_faces(const Frame& frame) { return frame == Frame{} ? cube_frame() : frame; }

// All maps and exports of one variant.
Status write_variant(const Manifest& manifest, const PanoramaEntry& entry, const Variant& variant,
                     const Coefficients& radiance, const Projection& projection,
                     const std::atomic<bool>& stop, std::vector<OutputRecord>& records) {
  const Frame frame = frame_of_faces(frame_of(*entry.settings, variant));
  for (const MapRequest& map : manifest.maps) {
    if (stop) return Error{ErrorCode::interrupted, "interrupted", entry.file, ""};
    const std::vector<std::string> names = map_files(manifest, entry, variant, map);
    SHOAL_RETURN_IF_ERROR(write_map_files(manifest, map,
                                          map_file(entry, variant, map, projection, frame),
                                          apply_quantity(radiance, map.kind), frame, names));
    for (const std::string& name : names) {
      SHOAL_ASSIGN_OR_RETURN(record, output_record(manifest, name, map));
      records.push_back(std::move(record));
    }
  }
  for (const ExportRequest& request : manifest.exports) {
    if (stop) return Error{ErrorCode::interrupted, "interrupted", entry.file, ""};
    SHOAL_ASSIGN_OR_RETURN(record, write_export(manifest, entry, variant, request, radiance));
    records.push_back(std::move(record));
  }
  return {};
}

}  // namespace

Result<ItemResults> make_item_results(const Manifest& manifest, const PanoramaEntry& entry,
                                      const Projection& projection, const std::atomic<bool>& stop) {
  ItemResults results;
  if (entry.settings->picture) {
    SHOAL_ASSIGN_OR_RETURN(picture, write_picture_file(manifest, entry));
    results.outputs.push_back(std::move(picture));
  }
  const bool files = !manifest.maps.empty() || !manifest.exports.empty();
  const bool figures = wants_quality(manifest, *entry.settings);
  if (!files && !figures) return results;
  VariantLights lights(projection, entry);
  for (const Variant& variant : manifest.variants) {
    SHOAL_ASSIGN_OR_RETURN(light, lights.in(variant));
    SHOAL_RETURN_IF_ERROR(
        write_variant(manifest, entry, variant, light.radiance, projection, stop, results.outputs));
    if (!figures) continue;
    SHOAL_ASSIGN_OR_RETURN(quality, lights.quality(variant, light));
    results.quality.push_back({variant.name, std::move(quality)});
  }
  return results;
}

Result<std::vector<VariantQuality>> item_quality(const Manifest& manifest,
                                                 const PanoramaEntry& entry,
                                                 const Projection& projection) {
  std::vector<VariantQuality> figures;
  VariantLights lights(projection, entry);
  for (const Variant& variant : manifest.variants) {
    SHOAL_ASSIGN_OR_RETURN(light, lights.in(variant));
    SHOAL_ASSIGN_OR_RETURN(quality, lights.quality(variant, light));
    figures.push_back({variant.name, std::move(quality)});
  }
  return figures;
}

Status make_item_records(const Manifest& manifest, const PanoramaEntry& entry,
                         const Projection& projection,
                         const std::function<Status(const CoefficientRecord&)>& take) {
  VariantLights lights(projection, entry);
  for (const Variant& variant : manifest.variants) {
    SHOAL_ASSIGN_OR_RETURN(light, lights.in(variant));
    const Frame frame = frame_of(*entry.settings, variant);
    const Coefficients in_frame = to_frame(light.radiance, frame);
    for (const Quantity quantity : manifest.quantities) {
      SHOAL_RETURN_IF_ERROR(
          take({entry.name, variant.name, quantity, apply_quantity(in_frame, quantity), frame}));
    }
  }
  return {};
}

}  // namespace shoal
