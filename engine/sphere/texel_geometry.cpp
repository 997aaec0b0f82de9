#include "sphere/texel_geometry.h"

#include <string>
#include <utility>

namespace shoal {
namespace {

TexelSpan turned(const TexelSpan& span, int count) {
  return {count - span.end, count - span.begin};
}

}  // namespace

Result<TexelGeometry> TexelGeometry::create(Layout layout, int width, int height) {
  const LayoutSize blocks = size_of(layout, 1);
  const int edge = width / blocks.width;
  const LayoutSize fitting = size_of(layout, edge);
  if (edge < 1 || fitting.width != width || fitting.height != height) {
    return Error{ErrorCode::usage,
                 "a picture of " + std::to_string(width) + " x " + std::to_string(height) +
                     " is none in the layout " + std::string(name_of(layout)) +
                     ", whose aspect is " + std::string(aspect_of(layout)),
                 "", "name the layout that it has"};
  }
  if (is_cube(layout)) return TexelGeometry(layout, width, height, CubeMapping(layout, edge));
  if (layout == Layout::angular || layout == Layout::mirror_ball) {
    return TexelGeometry(layout, width, height, DiscMapping(layout, edge));
  }
  return TexelGeometry(layout, width, height, OctahedralMapping(layout, edge));
}

std::int64_t TexelGeometry::texel_count() const {
  std::int64_t count = 0;
  for (int row = 0; row < height_; ++row) count += row_span(row).size();
  return count;
}

TexelSpan TexelGeometry::row_span(int row) const {
  if (const auto* cube = std::get_if<CubeMapping>(&mapping_)) {
    const auto [begin, end] = cube->row_range(row);
    return {begin, end};
  }
  if (const auto* disc = std::get_if<DiscMapping>(&mapping_)) {
    const auto [begin, end] = disc->range(row);
    return {begin, end};
  }
  return {0, width_};
}

TexelSpan TexelGeometry::column_span(int column) const {
  if (const auto* cube = std::get_if<CubeMapping>(&mapping_)) {
    const auto [begin, end] = cube->column_range(column);
    return {begin, end};
  }
  if (const auto* disc = std::get_if<DiscMapping>(&mapping_)) {
    const auto [begin, end] = disc->range(column);
    return {begin, end};
  }
  return {0, height_};
}

TexelSpan TexelGeometry::span_of(const TexelLine& line) const {
  const bool along_row = line.row_step == 0;
  const TexelSpan span = along_row ? row_span(line.row) : column_span(line.column);
  const int step = along_row ? line.column_step : line.row_step;
  return step > 0 ? span : turned(span, line.count);
}

Texel TexelGeometry::texel(int row, int column) const {
  return std::visit([&](const auto& mapping) { return mapping.texel(row, column); }, mapping_);
}

double TexelGeometry::fill(const TexelLine& line, const TexelSpan& span,
                           const TexelArrays& arrays) const {
  return std::visit([&](const auto& mapping) { return mapping.fill(line, span, arrays); },
                    mapping_);
}

}  // namespace shoal
