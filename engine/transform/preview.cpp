#include "transform/preview.h"

#include <algorithm>
#include <memory>
#include <utility>

#include "transform/area_weights.h"
#include "transform/layout_preview.h"
#include "transform/layout_source.h"
#include "transform/simd_codecs.h"
#include "transform/small_picture.h"

namespace shoal {
namespace {

Result<SmallPicture> equirect_preview(const PanoramaSource& source, int width,
                                      const std::atomic<bool>& stop) {
  const PictureInfo& info = source.info();
  const bool on_poles = info.positions == PixelPositions::endpoints;
  const Sampling sampling = on_poles ? Sampling::endpoints : Sampling::centers;
  // The cells of a grid that ends on the poles are one less than its texels.
  const int missing = on_poles ? 1 : 0;
  const int columns = std::min(width, std::max(1, info.width - missing));
  const int rows = std::min((columns + 1) / 2, std::max(1, info.height - missing));
  return shrink(source, {rows, row_shares(info.height, rows, sampling)},
                {columns, column_shares(info.width, columns, sampling)}, nullptr, stop);
}

}  // namespace

Result<Preview> make_preview(const std::filesystem::path& path, const ReadOptions& options,
                             const PreviewSettings& settings, const std::atomic<bool>& stop) {
  const ChunkCodecs codecs = simd_chunk_codecs();
  SHOAL_ASSIGN_OR_RETURN(picture, open_picture(path, options, codecs, settings.layout));
  const PictureInfo& info = picture.source->info();
  const bool is_equirect = picture.layout == Layout::equirect;
  Result<SmallPicture> small = is_equirect ? equirect_preview(*picture.source, settings.width, stop)
                                           : layout_preview(picture, settings.width, stop);
  if (!small) return std::move(small).error();
  Preview preview;
  preview.width = small->width;
  preview.height = small->height;
  preview.planes = std::move(small->planes);
  preview.layout = picture.layout;
  preview.warnings = info.warnings;
  std::ranges::copy(picture.notes, std::back_inserter(preview.warnings));
  if (is_equirect && info.positions == PixelPositions::endpoints) {
    preview.warnings.emplace_back(
        "Its border texels lie on the poles and on the seam; the preview takes each texel for the "
        "cell around it.");
  }
  return preview;
}

Status write_preview(const Preview& preview, MapFormat format, const std::filesystem::path& path) {
  MapFile file;
  file.format = format;
  file.width = preview.width;
  file.height = preview.height;
  SHOAL_ASSIGN_OR_RETURN(writer, MapWriter::create(path, file));
  const auto& [red, green, blue] = preview.planes;
  SHOAL_RETURN_IF_ERROR(
      writer->write_rows({red.data(), green.data(), blue.data()}, preview.width, preview.height));
  return writer->commit();
}

}  // namespace shoal
