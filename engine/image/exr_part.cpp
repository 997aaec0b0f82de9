#include "image/exr_part.h"

#include <algorithm>
#include <array>

namespace shoal {
namespace {

ExrWindow half_open(const exr_attr_box2i_t& box) {
  return {box.min.x, box.min.y, box.max.x + 1, box.max.y + 1};
}

SampleType sample_type(exr_pixel_type_t type) {
  if (type == EXR_PIXEL_HALF) return SampleType::half;
  return type == EXR_PIXEL_FLOAT ? SampleType::float32 : SampleType::uint32;
}

ExrStorage storage_of(exr_storage_t storage) {
  if (storage == EXR_STORAGE_SCANLINE) return ExrStorage::scanlines;
  return storage == EXR_STORAGE_TILED ? ExrStorage::tiles : ExrStorage::deep;
}

Status read_windows(const ExrContext& context, ExrPart& part) {
  const std::string& where = context.file().path();
  exr_attr_box2i_t data{};
  exr_attr_box2i_t display{};
  SHOAL_RETURN_IF_ERROR(
      context.run(where, [&] { return exr_get_data_window(context.handle(), part.index, &data); }));
  SHOAL_RETURN_IF_ERROR(context.run(
      where, [&] { return exr_get_display_window(context.handle(), part.index, &display); }));
  part.data = half_open(data);
  part.display = half_open(display);
  return {};
}

Status read_channels(const ExrContext& context, ExrPart& part) {
  const exr_attr_chlist_t* list = nullptr;
  SHOAL_RETURN_IF_ERROR(context.run(context.file().path(), [&] {
    return exr_get_channels(context.handle(), part.index, &list);
  }));
  for (int i = 0; i < list->num_channels; ++i) {
    const exr_attr_chlist_entry_t& entry = list->entries[i];
    part.channels.push_back(
        {entry.name.str, sample_type(entry.pixel_type), entry.x_sampling, entry.y_sampling});
  }
  return {};
}

// Tiles may be declared larger than the data window; a chunk then holds the window's part only.
Status read_chunk_size(const ExrContext& context, ExrPart& part) {
  const std::string& where = context.file().path();
  if (part.storage == ExrStorage::tiles) {
    std::uint32_t width = 0;
    std::uint32_t height = 0;
    exr_tile_level_mode_t level{};
    exr_tile_round_mode_t round{};
    SHOAL_RETURN_IF_ERROR(context.run(where, [&] {
      return exr_get_tile_descriptor(context.handle(), part.index, &width, &height, &level, &round);
    }));
    part.declared_tile_width = width;
    part.declared_tile_height = height;
    part.chunk_columns = static_cast<int>(std::min<std::int64_t>(width, part.data.width()));
    part.chunk_rows = static_cast<int>(std::min<std::int64_t>(height, part.data.height()));
  } else {
    std::int32_t lines = 1;
    SHOAL_RETURN_IF_ERROR(context.run(
        where, [&] { return exr_get_scanlines_per_chunk(context.handle(), part.index, &lines); }));
    part.chunk_columns = static_cast<int>(part.data.width());
    part.chunk_rows = lines;
  }
  if (part.chunk_rows > 0 && part.chunk_columns > 0) return {};
  return Error{ErrorCode::malformed, "declares chunks without pixels", where, ""};
}

void read_optional_attributes(const ExrContext& context, ExrPart& part) {
  exr_envmap_t envmap{};
  if (exr_attr_get_envmap(context.handle(), part.index, "envmap", &envmap) == EXR_ERR_SUCCESS &&
      (envmap == EXR_ENVMAP_LATLONG || envmap == EXR_ENVMAP_CUBE)) {
    part.envmap = envmap;
  }
  exr_attr_chromaticities_t primaries{};
  if (exr_attr_get_chromaticities(context.handle(), part.index, "chromaticities", &primaries) ==
      EXR_ERR_SUCCESS) {
    part.chromaticities = primaries;
  }
  const char* name = nullptr;
  if (exr_get_name(context.handle(), part.index, &name) == EXR_ERR_SUCCESS && name) {
    part.name = name;
  }
}

Result<ExrPart> read_part(const ExrContext& context, int index) {
  ExrPart part;
  part.index = index;
  exr_storage_t storage{};
  SHOAL_RETURN_IF_ERROR(context.run(
      context.file().path(), [&] { return exr_get_storage(context.handle(), index, &storage); }));
  part.storage = storage_of(storage);
  SHOAL_RETURN_IF_ERROR(context.run(context.file().path(), [&] {
    return exr_get_compression(context.handle(), index, &part.compression);
  }));
  SHOAL_RETURN_IF_ERROR(read_windows(context, part));
  SHOAL_RETURN_IF_ERROR(read_channels(context, part));
  SHOAL_RETURN_IF_ERROR(read_chunk_size(context, part));
  read_optional_attributes(context, part);
  return part;
}

}  // namespace

bool ExrPart::has_subsampling() const {
  return std::any_of(channels.begin(), channels.end(),
                     [](const ExrChannel& channel) { return channel.is_subsampled(); });
}

std::uint64_t ExrPart::pixel_bytes() const {
  std::uint64_t bytes = 0;
  for (const ExrChannel& channel : channels) bytes += sample_size(channel.type);
  return bytes;
}

std::vector<SampleType> ExrPart::sample_types() const {
  std::vector<SampleType> types;
  for (const ExrChannel& channel : channels) types.push_back(channel.type);
  return types;
}

Result<std::vector<ExrPart>> read_exr_parts(const ExrContext& context) {
  std::vector<ExrPart> parts;
  for (int index = 0; index < context.part_count(); ++index) {
    SHOAL_ASSIGN_OR_RETURN(part, read_part(context, index));
    parts.push_back(std::move(part));
  }
  return parts;
}

std::string exr_compression_name(exr_compression_t compression) {
  static constexpr std::array kNames = {"uncompressed", "RLE", "ZIPS", "ZIP",  "PIZ",
                                        "PXR24",        "B44", "B44A", "DWAA", "DWAB"};
  const auto index = static_cast<std::size_t>(compression);
  return index < kNames.size() ? kNames[index] : "compression " + std::to_string(index);
}

}  // namespace shoal
