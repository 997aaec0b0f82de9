// Maps into picture files, row by row from the top: OpenEXR, Radiance .hdr, PNG.
//
// A file appears under its name at commit(), whole, or never. The same rows give the same bytes.
#pragma once

#include <array>
#include <cstddef>
#include <filesystem>
#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "core/result.h"

namespace shoal {

enum class MapFormat {
  exr_half,   // OpenEXR, ZIP, channels R, G, B; beyond +-65504 becomes +-65504
  exr_float,  // OpenEXR, ZIP, channels R, G, B; bit for bit
  hdr,        // Radiance RGBE; see encode_rgbe()
  png,        // 8-bit preview; see preview_sample()
};

struct MapFile {
  // What the file says of where its pixels look, that its readers go by.
  enum class Environment {
    none,
    cube,  // EXR's envmap CUBE; no other format can say so
  };
  MapFormat format = MapFormat::exr_half;
  int width = 0;  // 1 .. kMaxSide, and so is the height
  int height = 0;
  double preview_exposure = 0.0;  // png: stops, -100 .. 100
  // Name and text, written into the file: string attributes (EXR), comment lines (hdr), text chunks
  // (png). Names have 1 to 79 of the characters ! to ~; texts are one line.
  std::vector<std::pair<std::string, std::string>> attributes;
  Environment environment = Environment::none;
};

class MapWriter {
 public:
  virtual ~MapWriter() = default;  // leaves nothing behind unless commit() succeeded

  // Errors: usage (a size or an attribute that no file can have, an environment that the format
  // cannot tell), write_failed.
  static Result<std::unique_ptr<MapWriter>> create(const std::filesystem::path& path,
                                                   const MapFile& file);

  // Appends rows of linear Rec.709: `planes` are red, green, blue, each from the first sample of
  // the first row, `stride` floats from a row to the next. Errors: write_failed; internal (more
  // rows than the map has).
  Status write_rows(const std::array<const float*, 3>& planes, std::ptrdiff_t stride,
                    int row_count);

  // After the last row. Errors: write_failed; internal (rows are missing).
  Status commit();

 protected:
  MapWriter(const std::filesystem::path& path, const MapFile& file);

  virtual Status encode_rows(const std::array<const float*, 3>& planes, std::ptrdiff_t stride,
                             int row_count) = 0;
  virtual Status finish() = 0;  // what comes behind the rows, then the file's own commit

  [[nodiscard]] Error write_error(std::string_view why) const;

  std::filesystem::path path_;
  int width_;
  int height_;

 private:
  int rows_written_ = 0;
};

// Red, green, blue and exponent of the texel nearest to a colour, under the decode m/256 *
// 2^(e-128) (RgbeDecode::floor): the exponent is the smallest that holds the largest component,
// mantissas are rounded to nearest, ties away from zero, so each component is within 2^-9 of the
// largest. Negative and NaN become 0, all that is below 2^-128 black, all above 255/256 * 2^127
// that.
[[nodiscard]] std::array<unsigned char, 4> encode_rgbe(float red, float green, float blue);

// The 8-bit sRGB sample of a preview: x = v * 2^exposure, the curve 1 - exp(-x), which is x for
// dark values and reaches white slowly, then sRGB. Negative and NaN become 0.
[[nodiscard]] unsigned char preview_sample(float value, double exposure);

}  // namespace shoal
