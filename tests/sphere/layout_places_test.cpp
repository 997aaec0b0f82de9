#include "sphere/layout_places.h"

#include <gtest/gtest.h>

#include <cmath>

#include "sphere/texel_geometry.h"

namespace shoal {
namespace {

// A texel's direction lies at the texel's centre, in every layout, at even and odd sizes. EXR's
// cubes have their border texels on the edges, where a direction belongs to two faces or three: of
// these only that the direction there is the same is asked. The direction behind a disc is that of
// its whole rim: places lose as much as texels are drawn out there, which is none of these.
TEST(LayoutPlaces, OfATexelsDirectionIsTheTexelsCentre) {
  for (const auto& [name, layout] : kLayoutNames) {
    if (layout == Layout::automatic || layout == Layout::equirect) continue;
    const LayoutPlaces places(layout);
    for (const int edge : {2, 5, 16, 33}) {
      const LayoutSize size = size_of(layout, edge);
      const auto geometry = TexelGeometry::create(layout, size.width, size.height);
      ASSERT_TRUE(geometry);
      const bool on_edges = layout == Layout::cube_openexr;
      for (int row = 0; row < size.height; ++row) {
        const TexelSpan span = geometry->span_of({row, 0, 0, 1, size.width});
        for (int column = span.begin; column < span.end; ++column) {
          const auto is_border = [&](int i) { return i % edge == 0 || i % edge == edge - 1; };
          if (on_edges && (is_border(row) || is_border(column))) continue;
          const LayoutPlace place = places.of(geometry->texel(row, column).direction);
          const auto centre = [&](int i) {
            return on_edges ? (i % edge) / (edge - 1.0) : (i % edge + 0.5) / edge;
          };
          EXPECT_EQ(place.block_row, row / edge) << name << " " << row << " " << column;
          EXPECT_EQ(place.block_column, column / edge) << name << " " << row << " " << column;
          EXPECT_NEAR(place.right, centre(column), 1e-13) << name << " " << row << " " << column;
          EXPECT_NEAR(place.down, centre(row), 1e-13) << name << " " << row << " " << column;
        }
      }
    }
  }
}

// Every direction has a place within a square, the awkward ones too.
TEST(LayoutPlaces, EveryDirectionHasOne) {
  for (const auto& [name, layout] : kLayoutNames) {
    if (layout == Layout::automatic || layout == Layout::equirect) continue;
    const LayoutPlaces places(layout);
    const LayoutSize blocks = size_of(layout, 1);
    for (const double x : {-1.0, 0.0, 1.0}) {
      for (const double y : {-1.0, 0.0, 1.0}) {
        for (const double z : {-1.0, 0.0, 1.0}) {
          const double length = std::sqrt(x * x + y * y + z * z);
          if (length == 0.0) continue;
          const LayoutPlace place = places.of({x / length, y / length, z / length});
          EXPECT_TRUE(place.right >= 0 && place.right <= 1 && place.down >= 0 && place.down <= 1)
              << name << " " << x << " " << y << " " << z;
          EXPECT_TRUE(place.block_row < blocks.height && place.block_column < blocks.width);
        }
      }
    }
  }
}

}  // namespace
}  // namespace shoal
