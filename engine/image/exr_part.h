// What the header says about the parts of an EXR file, as plain values.
#pragma once

#include <openexr.h>

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "core/result.h"
#include "core/row_band.h"
#include "image/exr_context.h"

namespace shoal {

enum class ExrStorage { scanlines, tiles, deep };

// Pixels [x_begin, x_end) x [y_begin, y_end) of the plane in which EXR's windows lie.
struct ExrWindow {
  int x_begin = 0;
  int y_begin = 0;
  int x_end = 0;
  int y_end = 0;

  [[nodiscard]] std::int64_t width() const { return std::int64_t{x_end} - x_begin; }
  [[nodiscard]] std::int64_t height() const { return std::int64_t{y_end} - y_begin; }
};

struct ExrChannel {
  std::string name;
  SampleType type = SampleType::half;
  int x_sampling = 1;
  int y_sampling = 1;

  [[nodiscard]] bool is_subsampled() const { return x_sampling != 1 || y_sampling != 1; }
};

struct ExrPart {
  int index = 0;
  std::string name;  // may be empty in files of one part
  ExrStorage storage = ExrStorage::scanlines;
  exr_compression_t compression = EXR_COMPRESSION_NONE;
  ExrWindow data;
  ExrWindow display;
  std::vector<ExrChannel> channels;  // in the file's order, by name
  int chunk_rows = 1;                // lines of a chunk, or the height of a tile of level 0
  int chunk_columns = 0;             // width of a chunk or of a tile of level 0
  // Of a tile as the header has it, before it is clipped to the data window.
  std::uint32_t declared_tile_width = 0;
  std::uint32_t declared_tile_height = 0;
  std::optional<exr_envmap_t> envmap;
  std::optional<exr_attr_chromaticities_t> chromaticities;

  [[nodiscard]] bool has_subsampling() const;
  // Bytes of a pixel, all channels (as if none were subsampled).
  [[nodiscard]] std::uint64_t pixel_bytes() const;
  [[nodiscard]] std::vector<SampleType> sample_types() const;
};

// All parts of the file, in its order. Errors: malformed.
Result<std::vector<ExrPart>> read_exr_parts(const ExrContext& context);

// "ZIP", "PIZ", ... for people.
[[nodiscard]] std::string exr_compression_name(exr_compression_t compression);

}  // namespace shoal
