#include "batch/item_outputs.h"

#include <fmt/format.h>

#include <utility>

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
  const bool strip = map.layout == MapLayout::cube && map.faces == CubeFaces::strip;
  file.width = strip ? 6 * map.width : map.width;
  file.height = map.height;
  file.preview_exposure = map.preview_stops;
  file.attributes = {
      {"shoal:panorama", entry.name},
      {"shoal:variant", variant.name},
      {"shoal:quantity", std::string(name_of(map.kind))},
      {"shoal:degree", std::to_string(projection.radiance.degree)},
      {"shoal:quadrature", std::string(name_of(projection.quadrature))},
  };
  if (map.layout == MapLayout::cube) file.attributes.emplace_back("shoal:frame", text_of(frame));
  return file;
}

// One map: one file, or six.
Status write_map_files(const Manifest& manifest, const MapRequest& map, const MapFile& file,
                       const Coefficients& native, const Frame& frame,
                       const std::vector<std::string>& names) {
  if (map.layout == MapLayout::equirect) {
    return write_equirect_map(native, manifest.output / names.front(), file);
  }
  const Coefficients in_frame = to_frame(native, frame);
  const auto packing = map.faces == CubeFaces::strip ? CubePacking::strip : CubePacking::face;
  for (std::size_t face = 0; face < names.size(); ++face) {
    SHOAL_RETURN_IF_ERROR(write_cube_map(in_frame, packing, static_cast<int>(face),
                                         manifest.output / names[face], file));
  }
  return {};
}

Result<OutputRecord> output_record(const Manifest& manifest, const std::string& name,
                                   const MapRequest& map) {
  const std::filesystem::path path = manifest.output / name;
  SHOAL_ASSIGN_OR_RETURN(hash, hash_file(path));
  std::error_code ignored;
  return OutputRecord{name, "map:" + std::string(name_of(map.kind)), hash,
                      std::filesystem::file_size(path, ignored)};
}

}  // namespace

Result<Coefficients> variant_radiance(const Projection& projection, const PanoramaEntry& entry,
                                      const Variant& variant) {
  SHOAL_ASSIGN_OR_RETURN(matrix, combined_matrix(colour_of(*entry.settings, variant)));
  return apply_matrix(projection.radiance, matrix);
}

Result<std::vector<OutputRecord>> write_item_maps(const Manifest& manifest,
                                                  const PanoramaEntry& entry,
                                                  const Projection& projection,
                                                  const std::atomic<bool>& stop) {
  std::vector<OutputRecord> records;
  if (manifest.maps.empty()) return records;
  for (const Variant& variant : manifest.variants) {
    SHOAL_ASSIGN_OR_RETURN(radiance, variant_radiance(projection, entry, variant));
    const Frame frame = frame_of(*entry.settings, variant);
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
  }
  return records;
}

Status make_item_records(const Manifest& manifest, const PanoramaEntry& entry,
                         const Projection& projection,
                         const std::function<Status(const CoefficientRecord&)>& take) {
  for (const Variant& variant : manifest.variants) {
    SHOAL_ASSIGN_OR_RETURN(radiance, variant_radiance(projection, entry, variant));
    const Frame frame = frame_of(*entry.settings, variant);
    const Coefficients in_frame = to_frame(radiance, frame);
    for (const Quantity quantity : manifest.quantities) {
      SHOAL_RETURN_IF_ERROR(
          take({entry.name, variant.name, quantity, apply_quantity(in_frame, quantity), frame}));
    }
  }
  return {};
}

}  // namespace shoal
