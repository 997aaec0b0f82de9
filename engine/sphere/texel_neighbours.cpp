#include "sphere/texel_neighbours.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <glm/geometric.hpp>

namespace shoal {
namespace {

bool is_disc(Layout layout) { return layout == Layout::angular || layout == Layout::mirror_ball; }

}  // namespace

TexelNeighbours::TexelNeighbours(Layout layout, int width, int height)
    : layout_(layout), width_(width), height_(height) {
  if (!is_cube(layout)) return;
  edge_ = width / size_of(layout, 1).width;
  blocks_ = cube_blocks(layout);
  places_.emplace(layout);
}

std::vector<TexelIndex> TexelNeighbours::of(const TexelIndex& texel) const {
  std::vector<TexelIndex> found;
  for (int down = -1; down <= 1; ++down) {
    for (int right = -1; right <= 1; ++right) {
      const auto next = neighbour(texel.row, texel.column, down, right);
      if (next) found.push_back(*next);
    }
  }
  return found;
}

int TexelNeighbours::common_point(const TexelIndex& texel) const {
  const auto [row, column] = texel;
  if (layout_ == Layout::equirect) return row == 0 ? 1 : row == height_ - 1 ? 2 : 0;
  if (!is_disc(layout_)) return 0;
  const bool is_inside = is_on_disc(row - 1, column) && is_on_disc(row + 1, column) &&
                         is_on_disc(row, column - 1) && is_on_disc(row, column + 1);
  return is_inside ? 0 : 1;
}

std::optional<TexelIndex> TexelNeighbours::neighbour(int row, int column, int down,
                                                     int right) const {
  if (!blocks_.empty()) return on_cube(row, column, down, right);
  const TexelIndex next{row + down, column + right};
  const bool is_within = next.row >= 0 && next.row < height_;
  if (layout_ == Layout::equirect) {
    if (!is_within) return std::nullopt;
    return TexelIndex{next.row, (next.column + width_) % width_};
  }
  if (!is_disc(layout_)) return on_octahedron(next.row, next.column);
  if (!is_within || next.column < 0 || next.column >= width_) return std::nullopt;
  return next;
}

// Beyond its edge a face goes on in its plane, and what is seen there is on another face.
TexelIndex TexelNeighbours::on_cube(int row, int column, int down, int right) const {
  const int block_row = row / edge_;
  const int block_column = column / edge_;
  const int in_row = row - block_row * edge_ + down;
  const int in_column = column - block_column * edge_ + right;
  const auto is_within = [&](int index) { return index >= 0 && index < edge_; };
  if (is_within(in_row) && is_within(in_column)) return {row + down, column + right};
  const int blocks_in_row = width_ / edge_;
  const CubeFace& face = blocks_[block_row * blocks_in_row + block_column].face;
  const LayoutPlace place = places_->of(glm::normalize(
      face.centre + place_on_face(in_column) * face.right + place_on_face(in_row) * face.down));
  return {place.block_row * edge_ + index_on_face(place.down),
          place.block_column * edge_ + index_on_face(place.right)};
}

// From -1 to 1; of a texel beyond the edge a place a quarter of a texel beyond it, which is within
// the texel on the other side.
double TexelNeighbours::place_on_face(int index) const {
  const bool on_edges = layout_ == Layout::cube_openexr && edge_ > 1;
  const double step = 2.0 / (on_edges ? edge_ - 1 : edge_);
  const double first = on_edges ? -1.0 : step / 2.0 - 1.0;
  return std::clamp(first + step * index, -1.0 - step / 4.0, 1.0 + step / 4.0);
}

// From a place in [0, 1].
int TexelNeighbours::index_on_face(double place) const {
  const bool on_edges = layout_ == Layout::cube_openexr && edge_ > 1;
  const double texels = on_edges ? place * (edge_ - 1) + 0.5 : place * edge_;
  return std::min(static_cast<int>(texels), edge_ - 1);
}

// The edges are folded in their middles, so that an edge's one half meets its other.
TexelIndex TexelNeighbours::on_octahedron(int row, int column) const {
  if (column < 0 || column >= width_) {
    row = height_ - 1 - row;
    column = std::clamp(column, 0, width_ - 1);
  }
  if (row < 0 || row >= height_) {
    column = width_ - 1 - column;
    row = std::clamp(row, 0, height_ - 1);
  }
  return {row, column};
}

// As DiscMapping has it: whether the centre is.
bool TexelNeighbours::is_on_disc(int row, int column) const {
  const std::int64_t right = 2 * std::int64_t{column} + 1 - width_;
  const std::int64_t down = 2 * std::int64_t{row} + 1 - width_;
  return right * right + down * down <= std::int64_t{width_} * width_;
}

}  // namespace shoal
