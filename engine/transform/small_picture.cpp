#include "transform/small_picture.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "transform/picture_sums.h"
#include "transform/scanline_means.h"

namespace shoal {
namespace {

ScanlineMeans means_for(const PictureInfo& info, SmallAxis rows, SmallAxis columns) {
  const bool by_rows = info.scan_axis == ScanAxis::rows;
  if (info.samples_reversed) std::ranges::reverse((by_rows ? columns : rows).shares);
  SmallAxis& lines = by_rows ? rows : columns;
  SmallAxis& samples = by_rows ? columns : rows;
  return {info.channel_count, std::move(lines.shares), std::move(samples.shares), lines.count,
          samples.count};
}

void keep_shown(const PictureInfo& info, const TexelGeometry& geometry, int number, int count,
                Scanline& scanline) {
  const ScanlinePlace place = scanline_place(info, number);
  const TexelSpan span =
      geometry.span_of({static_cast<int>(place.row), static_cast<int>(place.column), place.row_step,
                        place.column_step, count});
  keep_only(span.begin, span.end, count, scanline);
}

Status gather(const PanoramaSource& source, const TexelGeometry* geometry,
              const std::atomic<bool>& stop, ScanlineMeans& means) {
  SHOAL_ASSIGN_OR_RETURN(reader, source.new_reader());
  kernels::RowMomentScratch scratch;
  Scanline scanline;
  for (int index = 0; index < source.info().band_count; ++index) {
    if (stop) return Error{ErrorCode::interrupted, "interrupted", "", ""};
    SHOAL_ASSIGN_OR_RETURN(band, reader->read(index));
    for (int row = 0; row < band.row_count(); ++row) {
      const int number = band.row_begin + row;
      read_scanline(band, row, scratch, scanline);
      if (geometry != nullptr) keep_shown(source.info(), *geometry, number, band.width, scanline);
      means.add(number, scanline);
    }
  }
  means.finish();
  return {};
}

float within_floats(double value) {
  constexpr double kMost = std::numeric_limits<float>::max();
  return static_cast<float>(std::clamp(value, -kMost, kMost));
}

SmallPicture picture_of(const PictureInfo& info, const ScanlineMeans& means, int width,
                        int height) {
  const bool by_rows = info.scan_axis == ScanAxis::rows;
  SmallPicture picture;
  picture.width = width;
  picture.height = height;
  const auto count = static_cast<std::size_t>(width) * height;
  for (auto& plane : picture.planes) plane.reserve(count);
  picture.has_light.reserve(count);
  for (int row = 0; row < height; ++row) {
    for (int column = 0; column < width; ++column) {
      const int line = by_rows ? row : column;
      const int sample = by_rows ? column : row;
      glm::dvec3 colour;
      for (int c = 0; c < 3; ++c) {
        colour[c] = means.mean(info.channel_count == 1 ? 0 : c, line, sample);
      }
      colour = info.to_linear_rec709 * colour;
      for (int c = 0; c < 3; ++c) picture.planes[c].push_back(within_floats(colour[c]));
      picture.has_light.push_back(means.has_light(line, sample) ? 1 : 0);
    }
  }
  return picture;
}

}  // namespace

Result<SmallPicture> shrink(const PanoramaSource& source, SmallAxis rows, SmallAxis columns,
                            const TexelGeometry* geometry, const std::atomic<bool>& stop) {
  const int width = columns.count;
  const int height = rows.count;
  ScanlineMeans means = means_for(source.info(), std::move(rows), std::move(columns));
  SHOAL_RETURN_IF_ERROR(gather(source, geometry, stop, means));
  return picture_of(source.info(), means, width, height);
}

}  // namespace shoal
