#include "sphere/texel_neighbours.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <glm/geometric.hpp>

#include "sphere/texel_geometry.h"

namespace shoal {
namespace {

constexpr Layout kFolded[] = {Layout::cube_vertical_cross,  Layout::cube_horizontal_cross,
                              Layout::cube_vertical_strip,  Layout::cube_horizontal_strip,
                              Layout::cube_openexr,         Layout::octahedral,
                              Layout::octahedral_equal_area};

// What touches over the edges of squares is no further apart than what touches within them.
TEST(TexelNeighbours, AreNear) {
  for (const Layout layout : kFolded) {
    for (const int edge : {8, 15}) {
      const LayoutSize size = size_of(layout, edge);
      const auto geometry = TexelGeometry::create(layout, size.width, size.height);
      ASSERT_TRUE(geometry);
      const TexelNeighbours neighbours(layout, size.width, size.height);
      double furthest_within = 0.0;
      double furthest_over = 0.0;
      for (int row = 0; row < size.height; ++row) {
        const TexelSpan span = geometry->span_of({row, 0, 0, 1, size.width});
        for (int column = span.begin; column < span.end; ++column) {
          const auto around = neighbours.of({row, column});
          EXPECT_EQ(around.size(), 9U);
          for (std::size_t i = 0; i < around.size(); ++i) {
            const auto [next_row, next_column] = around[i];
            const double way = glm::length(geometry->texel(row, column).direction -
                                           geometry->texel(next_row, next_column).direction);
            const TexelIndex beside{row + static_cast<int>(i) / 3 - 1,
                                    column + static_cast<int>(i) % 3 - 1};
            double& furthest = around[i] == beside ? furthest_within : furthest_over;
            furthest = std::max(furthest, way);
          }
        }
      }
      EXPECT_LE(furthest_over, furthest_within) << name_of(layout) << " " << edge;
    }
  }
}

// Side by side is so from both sides.
TEST(TexelNeighbours, TouchOneAnother) {
  for (const Layout layout : kFolded) {
    const LayoutSize size = size_of(layout, 9);
    const auto geometry = TexelGeometry::create(layout, size.width, size.height);
    ASSERT_TRUE(geometry);
    const TexelNeighbours neighbours(layout, size.width, size.height);
    for (int row = 0; row < size.height; ++row) {
      const TexelSpan span = geometry->span_of({row, 0, 0, 1, size.width});
      for (int column = span.begin; column < span.end; ++column) {
        const TexelIndex texel{row, column};
        const auto around = neighbours.of(texel);
        // Found in the order of rows: above, left, right, below.
        for (const std::size_t side : {1U, 3U, 5U, 7U}) {
          const auto back = neighbours.of(around[side]);
          EXPECT_TRUE(std::ranges::find(back, texel) != back.end())
              << name_of(layout) << " " << row << " " << column << " side " << side;
        }
      }
    }
  }
}

TEST(TexelNeighbours, OfAnEquirectPictureGoOverTheSeam) {
  const TexelNeighbours neighbours(Layout::equirect, 8, 4);
  const auto around = neighbours.of({1, 0});
  for (const int row : {0, 1, 2}) {
    for (const int column : {7, 0, 1}) {
      EXPECT_TRUE(std::ranges::find(around, TexelIndex{row, column}) != around.end());
    }
  }
  EXPECT_EQ(neighbours.of({0, 3}).size(), 6U);
  EXPECT_EQ(neighbours.common_point({0, 3}), 1);
  EXPECT_EQ(neighbours.common_point({3, 3}), 2);
  EXPECT_EQ(neighbours.common_point({1, 3}), 0);
}

// The rim is where a side of a texel's square leads outside.
TEST(TexelNeighbours, OfADiscMeetBehindIt) {
  for (const int size : {1, 2, 7, 32}) {
    const auto geometry = TexelGeometry::create(Layout::angular, size, size);
    ASSERT_TRUE(geometry);
    const TexelNeighbours neighbours(Layout::angular, size, size);
    const auto shows = [&](int row, int column) {
      if (row < 0 || row >= size) return false;
      const TexelSpan span = geometry->span_of({row, 0, 0, 1, size});
      return column >= span.begin && column < span.end;
    };
    for (int row = 0; row < size; ++row) {
      for (int column = 0; column < size; ++column) {
        if (!shows(row, column)) continue;
        const bool is_inside = shows(row - 1, column) && shows(row + 1, column) &&
                               shows(row, column - 1) && shows(row, column + 1);
        EXPECT_EQ(neighbours.common_point({row, column}), is_inside ? 0 : 1);
      }
    }
  }
}

}  // namespace
}  // namespace shoal
