#include "sphere/layout_places.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <glm/geometric.hpp>
#include <numbers>

namespace shoal {
namespace {

constexpr double kPi = std::numbers::pi;

// From [-1, 1] to [0, 1]; rounding does not lead outside.
double from_edge(double from_middle) { return std::clamp(0.5 + 0.5 * from_middle, 0.0, 1.0); }

}  // namespace

LayoutPlaces::LayoutPlaces(Layout layout)
    : layout_(layout), block_columns_(size_of(layout, 1).width) {
  if (is_cube(layout)) blocks_ = cube_blocks(layout);
}

LayoutPlace LayoutPlaces::of(const glm::dvec3& direction) const {
  if (!blocks_.empty()) return on_cube(direction);
  const bool is_disc = layout_ == Layout::angular || layout_ == Layout::mirror_ball;
  return is_disc ? on_disc(direction) : on_octahedron(direction);
}

LayoutPlace LayoutPlaces::on_cube(const glm::dvec3& direction) const {
  const auto towards = [&](const CubeBlock& block) {
    return block.number < 0 ? -1.0 : glm::dot(block.face.centre, direction);
  };
  const auto block = std::ranges::max_element(blocks_, {}, towards);
  const auto index = static_cast<int>(block - blocks_.begin());
  const double depth = towards(*block);
  return {index / block_columns_, index % block_columns_,
          from_edge(glm::dot(block->face.right, direction) / depth),
          from_edge(glm::dot(block->face.down, direction) / depth)};
}

LayoutPlace LayoutPlaces::on_disc(const glm::dvec3& direction) const {
  const double sine = std::hypot(direction.y, direction.z);
  const double angle = std::atan2(sine, -direction.x);
  const double r = layout_ == Layout::angular ? angle / kPi : std::sin(angle / 2.0);
  if (sine == 0.0) return {0, 0, from_edge(r), 0.5};
  return {0, 0, from_edge(-direction.y / sine * r), from_edge(-direction.z / sine * r)};
}

LayoutPlace LayoutPlaces::on_octahedron(const glm::dvec3& direction) const {
  const glm::dvec3 size(std::abs(direction.x), std::abs(direction.y), std::abs(direction.z));
  double u = 0.0;
  double v = 0.0;
  if (layout_ == Layout::octahedral_equal_area) {
    // 1 - |z| = r^2, without loss near the poles.
    const double r = std::hypot(size.x, size.y) / std::sqrt(1.0 + size.z);
    v = r * std::atan2(size.y, size.x) * 2.0 / kPi;
    u = r - v;
  } else {
    u = size.x / (size.x + size.y + size.z);
    v = size.y / (size.x + size.y + size.z);
  }
  // The lower half is folded over the edge u + v = 1.
  const double across = direction.z < 0.0 ? 1.0 - v : u;
  const double along = direction.z < 0.0 ? 1.0 - u : v;
  return {0, 0, from_edge(std::copysign(across, direction.x)),
          from_edge(std::copysign(along, direction.y))};
}

}  // namespace shoal
