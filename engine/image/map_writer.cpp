#include "image/map_writer.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "image/map_formats.h"
#include "image/panorama_source.h"

namespace shoal {
namespace {

constexpr double kMaxStops = 100.0;  // 2^100 times any float is still a double

Status check(const std::filesystem::path& path, const MapFile& file) {
  const auto is_side = [](int side) { return side >= 1 && side <= kMaxSide; };
  if (!is_side(file.width) || !is_side(file.height)) {
    return Error{ErrorCode::usage,
                 fmt::format("a map of {} x {} cannot be written", file.width, file.height),
                 path.string(), fmt::format("sides are 1 to {}", kMaxSide)};
  }
  if (!(std::abs(file.preview_exposure) <= kMaxStops)) {
    return Error{ErrorCode::usage,
                 fmt::format("{} stops are no exposure of a preview", file.preview_exposure),
                 path.string(), fmt::format("at most {} up or down", kMaxStops)};
  }
  const bool is_exr = file.format == MapFormat::exr_half || file.format == MapFormat::exr_float;
  if (file.environment != MapFile::Environment::none && !is_exr) {
    return Error{ErrorCode::usage, "only OpenEXR has an envmap attribute", path.string(),
                 "write the map as exr"};
  }
  const auto in_name = [](char c) { return c > ' ' && c <= '~'; };
  const auto in_text = [](char c) { return c != '\n' && c != '\r' && c != '\0'; };
  for (const auto& [name, text] : file.attributes) {
    const bool valid = !name.empty() && name.size() <= 79 &&
                       std::all_of(name.begin(), name.end(), in_name) &&
                       std::all_of(text.begin(), text.end(), in_text);
    if (!valid) {
      return Error{ErrorCode::usage, fmt::format("no map can hold the attribute \"{}\"", name),
                   path.string(), "names are words of at most 79 letters; texts are one line"};
    }
  }
  return {};
}

}  // namespace

MapWriter::MapWriter(const std::filesystem::path& path, const MapFile& file)
    : path_(path), width_(file.width), height_(file.height) {}

Result<std::unique_ptr<MapWriter>> MapWriter::create(const std::filesystem::path& path,
                                                     const MapFile& file) {
  SHOAL_RETURN_IF_ERROR(check(path, file));
  switch (file.format) {
    case MapFormat::exr_half:
    case MapFormat::exr_float:
      return create_exr_map(path, file);
    case MapFormat::hdr:
      return create_hdr_map(path, file);
    case MapFormat::png:
      return create_png_map(path, file);
  }
  return Error{ErrorCode::internal, "no such map format", path.string(), ""};
}

Status MapWriter::write_rows(const std::array<const float*, 3>& planes, std::ptrdiff_t stride,
                             int row_count) {
  if (row_count < 0 || row_count > height_ - rows_written_) {
    return Error{ErrorCode::internal, fmt::format("more than the map's {} rows came", height_),
                 path_.string(), ""};
  }
  rows_written_ += row_count;
  return encode_rows(planes, stride, row_count);
}

Status MapWriter::commit() {
  if (rows_written_ != height_) {
    return Error{ErrorCode::internal,
                 fmt::format("only {} of the map's {} rows came", rows_written_, height_),
                 path_.string(), ""};
  }
  return finish();
}

Error MapWriter::write_error(std::string_view why) const {
  return Error{ErrorCode::write_failed, "cannot be written: " + std::string(why), path_.string(),
               ""};
}

}  // namespace shoal
