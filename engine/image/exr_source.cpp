#include "image/exr_source.h"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <string_view>
#include <utility>

#include "image/exr_band_reader.h"
#include "image/exr_core_reader.h"
#include "image/exr_imf_reader.h"
#include "image/exr_scanline_reader.h"
#include "image/exr_tile_reader.h"

namespace shoal {
namespace {

// x, y of red, green, blue and white (ITU-R BT.709).
constexpr std::array<float, 8> kRec709 = {0.64f, 0.33f, 0.30f,   0.60f,
                                          0.15f, 0.06f, 0.3127f, 0.3290f};

bool is_rec709(const exr_attr_chromaticities_t& c) {
  const std::array<float, 8> values = {c.red_x,  c.red_y,  c.green_x, c.green_y,
                                       c.blue_x, c.blue_y, c.white_x, c.white_y};
  constexpr float kRounding = 1e-3f;  // writers round differently, the white point above all
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (!(std::fabs(values[i] - kRec709[i]) <= kRounding)) return false;
  }
  return true;
}

std::string chromaticities_warning(const exr_attr_chromaticities_t& c) {
  return fmt::format(
      "the chromaticities are not those of Rec. 709 (red {:.4g} {:.4g}, green {:.4g} {:.4g}, blue "
      "{:.4g} {:.4g}, white {:.4g} {:.4g}); the colours are taken as they are",
      float{c.red_x}, float{c.red_y}, float{c.green_x}, float{c.green_y}, float{c.blue_x},
      float{c.blue_y}, float{c.white_x}, float{c.white_y});
}

std::string coverage_warning(const ExrLayout& layout) {
  return fmt::format("the data window covers {:.4g} % of the picture; the rest is taken as black",
                     100.0 * layout.covered_fraction());
}

std::string_view sample_name(SampleType type) {
  if (type == SampleType::half) return "half";
  return type == SampleType::float32 ? "float" : "uint";
}

std::string_view model_name(ExrColourModel model) {
  if (model == ExrColourModel::grey) return " grey";
  return model == ExrColourModel::luminance_chroma ? " luminance/chroma" : "";
}

std::string format_name(const ExrPicture& picture) {
  return fmt::format("OpenEXR {}{} {}{}", sample_name(picture.sample_type(0)),
                     model_name(picture.colour.model),
                     exr_compression_name(picture.part.compression),
                     picture.part.storage == ExrStorage::tiles ? " tiles" : "");
}

PictureInfo describe(const ExrPicture& picture) {
  PictureInfo info;
  info.format = format_name(picture);
  info.width = picture.layout.width;
  info.height = picture.layout.height;
  info.channel_count = picture.colour.channel_count();
  if (picture.part.envmap) {
    info.positions = PixelPositions::endpoints;
    const bool is_cube = picture.part.envmap == EXR_ENVMAP_CUBE;
    info.environment = is_cube ? EnvironmentMap::cube : EnvironmentMap::latlong;
  }
  info.band_count = picture.layout.band_count();
  info.rows_per_band = picture.layout.rows_per_band();
  if (picture.layout.covered_fraction() < 1.0) {
    info.warnings.push_back(coverage_warning(picture.layout));
  }
  if (picture.part.chromaticities && !is_rec709(*picture.part.chromaticities)) {
    info.warnings.push_back(chromaticities_warning(*picture.part.chromaticities));
  }
  return info;
}

class ExrSource final : public PanoramaSource {
 public:
  explicit ExrSource(std::shared_ptr<const ExrPicture> picture)
      : picture_(std::move(picture)), info_(describe(*picture_)) {}

  [[nodiscard]] const PictureInfo& info() const override { return info_; }

  [[nodiscard]] Result<std::unique_ptr<BandReader>> new_reader() const override {
    std::unique_ptr<BandReader> reader;
    if (ExrScanlineReader::can_read(picture_->part, picture_->colour)) {
      reader = std::make_unique<ExrScanlineReader>(picture_);
    } else if (ExrTileReader::can_read(picture_->part, picture_->colour)) {
      reader = std::make_unique<ExrTileReader>(picture_);
    } else if (ExrCoreReader::can_read(picture_->part, picture_->colour)) {
      reader = std::make_unique<ExrCoreReader>(picture_);
    } else {
      return new_exr_imf_reader(picture_);
    }
    return reader;
  }

 private:
  std::shared_ptr<const ExrPicture> picture_;
  PictureInfo info_;
};

}  // namespace

Result<std::unique_ptr<PanoramaSource>> open_exr(const std::filesystem::path& path,
                                                 const ReadOptions& options,
                                                 const ChunkCodecs& codecs) {
  SHOAL_ASSIGN_OR_RETURN(context, ExrContext::open(path, options.recorder));
  SHOAL_ASSIGN_OR_RETURN(parts, read_exr_parts(*context));
  SHOAL_ASSIGN_OR_RETURN(selection, select_exr_colour(parts, options, context->file().path()));
  const ExrPart& part = parts[selection.part];
  SHOAL_ASSIGN_OR_RETURN(layout,
                         lay_out_exr(*context, part, selection.colour, options.rows_per_band));
  ExrChunkTable chunks;
  if (ExrScanlineReader::can_read(part, selection.colour)) {
    SHOAL_ASSIGN_OR_RETURN(table, ExrChunkTable::read(*context, part));
    chunks = std::move(table);
  }
  auto picture = std::make_shared<const ExrPicture>(
      ExrPicture{std::move(context), part, selection.colour, layout, options.layer, codecs,
                 std::move(chunks)});
  return std::unique_ptr<PanoramaSource>(std::make_unique<ExrSource>(std::move(picture)));
}

}  // namespace shoal
