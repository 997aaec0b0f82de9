// Where the texels of a picture look, and how much of the sphere each shows: every layout but
// equirect, whose rows factor (sphere/quadrature.h). Reading and writing share it.
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <variant>
#include <vector>

#include "core/result.h"
#include "sphere/layout.h"
#include "sphere/texel_mappings.h"

namespace shoal {

class TexelGeometry {
 public:
  // Error: usage, where such a picture does not have such a size.
  // Precondition: a layout other than automatic and equirect.
  static Result<TexelGeometry> create(Layout layout, int width, int height);

  [[nodiscard]] Layout layout() const { return layout_; }
  [[nodiscard]] int width() const { return width_; }
  [[nodiscard]] int height() const { return height_; }

  // How many texels show some of the sphere.
  [[nodiscard]] std::int64_t texel_count() const;

  // A line of a whole row or of a whole column.
  [[nodiscard]] TexelSpan span_of(const TexelLine& line) const;

  // Precondition: the texel is in the span of its line.
  [[nodiscard]] Texel texel(int row, int column) const;

  // All of a span's texels; the arrays begin with its first. Returns the sum of their solid angles.
  double fill(const TexelLine& line, const TexelSpan& span, const TexelArrays& arrays) const;

 private:
  using Mapping = std::variant<CubeMapping, DiscMapping, OctahedralMapping>;

  TexelGeometry(Layout layout, int width, int height, Mapping mapping)
      : layout_(layout), width_(width), height_(height), mapping_(std::move(mapping)) {}

  [[nodiscard]] TexelSpan row_span(int row) const;
  [[nodiscard]] TexelSpan column_span(int column) const;

  Layout layout_;
  int width_;
  int height_;
  Mapping mapping_;
};

}  // namespace shoal
