#include "sphere/texel_geometry.h"

#include <gmock/gmock.h>

#include <cmath>
#include <glm/glm.hpp>
#include <numbers>
#include <set>
#include <vector>

namespace shoal {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr Layout kAll[] = {Layout::cube_vertical_cross,
                           Layout::cube_horizontal_cross,
                           Layout::cube_vertical_strip,
                           Layout::cube_horizontal_strip,
                           Layout::cube_faces,
                           Layout::cube_openexr,
                           Layout::angular,
                           Layout::mirror_ball,
                           Layout::octahedral,
                           Layout::octahedral_equal_area};

TexelGeometry make(Layout layout, int edge) {
  const LayoutSize size = size_of(layout, edge);
  auto geometry = TexelGeometry::create(layout, size.width, size.height);
  EXPECT_TRUE(geometry) << geometry.error().text();
  return std::move(geometry).value();
}

template <typename Visit>
void for_each_texel(const TexelGeometry& geometry, const Visit& visit) {
  for (int row = 0; row < geometry.height(); ++row) {
    const TexelSpan span = geometry.span_of({row, 0, 0, 1, geometry.width()});
    for (int column = span.begin; column < span.end; ++column) {
      visit(row, column, geometry.texel(row, column));
    }
  }
}

double sum_of_solid_angles(const TexelGeometry& geometry) {
  long double sum = 0.0L;
  for_each_texel(geometry, [&](int, int, const Texel& texel) { sum += texel.solid_angle; });
  return static_cast<double>(sum);
}

// The native frame: the panorama's centre is -x, its right -y, up +z.
const glm::dvec3 kFront(-1.0, 0.0, 0.0), kRight(0.0, -1.0, 0.0), kUp(0.0, 0.0, 1.0);

TEST(Layout, NamesReadBack) {
  for (const LayoutName& known : kLayoutNames) {
    EXPECT_EQ(name_of(known.layout), known.name);
    const auto parsed = parse_layout(known.name);
    ASSERT_TRUE(parsed);
    EXPECT_EQ(*parsed, known.layout);
  }
  const auto wrong = parse_layout("angluar");
  ASSERT_FALSE(wrong);
  EXPECT_THAT(wrong.error().hint, testing::HasSubstr("angular"));
}

TEST(Layout, IsToldByTheAspect) {
  EXPECT_EQ(layout_of_aspect(1024, 512), Layout::equirect);
  EXPECT_EQ(layout_of_aspect(768, 1024), Layout::cube_vertical_cross);
  EXPECT_EQ(layout_of_aspect(1024, 768), Layout::cube_horizontal_cross);
  EXPECT_EQ(layout_of_aspect(64, 384), Layout::cube_vertical_strip);
  EXPECT_EQ(layout_of_aspect(384, 64), Layout::cube_horizontal_strip);
  EXPECT_EQ(layout_of_aspect(640, 640), Layout::angular);
  EXPECT_EQ(layout_of_aspect(1025, 512), std::nullopt);
}

TEST(TexelGeometry, RefusesSizesThatALayoutDoesNotHave) {
  const auto cross = TexelGeometry::create(Layout::cube_vertical_cross, 30, 41);
  ASSERT_FALSE(cross);
  EXPECT_EQ(cross.error().code, ErrorCode::usage);
  EXPECT_THAT(cross.error().what, testing::HasSubstr("3:4"));
  EXPECT_FALSE(TexelGeometry::create(Layout::angular, 64, 63));
  EXPECT_FALSE(TexelGeometry::create(Layout::cube_vertical_strip, 0, 0));
}

// Faces cover the sphere once: 6 faces of 4 pi/6. So does the unfolded octahedron. Sizes on both
// sides of where an expansion takes the place of the closed form, whose error is allowed 1e-9.
TEST(TexelGeometry, SolidAnglesSumToTheSphere) {
  for (const int edge : {1, 2, 3, 4, 7, 16, 33}) {
    for (const Layout layout : kAll) {
      if (layout == Layout::angular || layout == Layout::mirror_ball) continue;
      EXPECT_NEAR(sum_of_solid_angles(make(layout, edge)), 4.0 * kPi, 1e-12 * 4.0 * kPi)
          << name_of(layout) << " " << edge;
    }
  }
  for (const Layout layout : {Layout::cube_vertical_strip, Layout::cube_openexr}) {
    EXPECT_NEAR(sum_of_solid_angles(make(layout, 260)), 4.0 * kPi, 1e-9 * 4.0 * kPi);
  }
  EXPECT_NEAR(sum_of_solid_angles(make(Layout::octahedral, 1030)), 4.0 * kPi, 1e-9 * 4.0 * kPi);
  EXPECT_NEAR(sum_of_solid_angles(make(Layout::octahedral, 1031)), 4.0 * kPi, 1e-9 * 4.0 * kPi);
}

// Where two smooth pieces of a mapping meet within a texel, or a direction turns too fast for
// differences: the octahedron's folds and poles, the mirror ball's rim.
bool is_smooth(Layout layout, int edge, int row, int column, const glm::dvec3& direction) {
  if (layout == Layout::mirror_ball) return direction.x < 0.8;
  if (layout != Layout::octahedral && layout != Layout::octahedral_equal_area) return true;
  const int u = std::abs(2 * column + 1 - edge), v = std::abs(2 * row + 1 - edge);
  return u > 0 && v > 0 && std::abs(u + v - edge) > 2 && std::abs(direction.z) < 0.99;
}

// A texel's solid angle is about |d direction/du x d direction/dv| of its middle, by differences of
// directions alone, which have nothing in common with the formulas of solid angles but the mapping:
// to O(h^2), 3 % here; a wrong factor or density is off by more. And a texel is the sum of the nine
// that it holds of a picture three times as large, to 1e-9.
TEST(TexelGeometry, SolidAnglesAreThoseOfTheMappings) {
  constexpr int kEdge = 63;
  constexpr double kMean = 4.0 * kPi / (6.0 * kEdge * kEdge);
  for (const Layout layout : kAll) {
    if (layout == Layout::cube_openexr) continue;  // its texels do not nest
    const TexelGeometry coarse = make(layout, kEdge);
    const TexelGeometry fine = make(layout, 3 * kEdge);
    for_each_texel(coarse, [&](int row, int column, const Texel& texel) {
      const TexelSpan first = fine.span_of({3 * row, 0, 0, 1, fine.width()});
      const TexelSpan last = fine.span_of({3 * row + 2, 0, 0, 1, fine.width()});
      const bool is_inside = 3 * column >= std::max(first.begin, last.begin) &&
                             3 * column + 3 <= std::min(first.end, last.end);
      if (!is_inside) return;  // on the rim of a disc
      double parts = 0.0;
      for (int k = 0; k < 9; ++k) {
        parts += fine.texel(3 * row + k / 3, 3 * column + k % 3).solid_angle;
      }
      EXPECT_NEAR(parts, texel.solid_angle, 1e-9 * kMean) << name_of(layout) << " " << row;
      if (!is_smooth(layout, kEdge, row, column, texel.direction)) return;
      const auto at = [&](int i, int j) {
        return fine.texel(3 * row + i, 3 * column + j).direction;
      };
      EXPECT_LT(glm::distance(at(1, 1), texel.direction), 1e-12);
      const glm::dvec3 normal = glm::cross(at(1, 2) - at(1, 0), at(2, 1) - at(0, 1));
      EXPECT_NEAR(glm::length(normal) * 9.0 / 4.0, texel.solid_angle,
                  0.03 * texel.solid_angle + 1e-3 * kMean)
          << name_of(layout) << " " << row << " " << column;
    });
  }
}

// The expansion of large sizes against the closed form: a texel of 100 is one of nine of 300 (two
// of octahedral sizes straddle the limit in the same way).
TEST(TexelGeometry, ExpansionsMeetTheClosedForms) {
  for (const auto& [layout, edge] :
       {std::pair{Layout::cube_horizontal_strip, 100}, std::pair{Layout::octahedral, 350},
        std::pair{Layout::angular, 100}}) {
    const TexelGeometry closed = make(layout, edge);
    const TexelGeometry expanded = make(layout, 3 * edge);
    for (int row = 30; row < 70; row += 7) {
      for (int column = 30; column < 70; column += 3) {
        double parts = 0.0;
        for (int k = 0; k < 9; ++k) {
          parts += expanded.texel(3 * row + k / 3, 3 * column + k % 3).solid_angle;
        }
        const double whole = closed.texel(row, column).solid_angle;
        EXPECT_NEAR(parts, whole, 1e-9 * whole) << name_of(layout) << " " << row << " " << column;
      }
    }
  }
}

// Corner differences of atan(st / sqrt(1 + s^2 + t^2)), the textbook's form for a rectangle.
TEST(TexelGeometry, CubeSolidAnglesAreTheTextbooks) {
  const auto corner = [](long double s, long double t) {
    return std::atan(s * t / std::sqrt(1.0L + s * s + t * t));
  };
  for (const int edge : {4, 61, 300}) {
    const TexelGeometry strip = make(Layout::cube_vertical_strip, edge);
    for (int row = 0; row < edge; row += 1 + edge / 13) {
      for (int column = 0; column < edge; column += 1 + edge / 11) {
        const long double s = 2.0L * column / edge - 1.0L, t = 2.0L * row / edge - 1.0L;
        const long double step = 2.0L / edge;
        const long double exact =
            corner(s + step, t + step) - corner(s, t + step) - corner(s + step, t) + corner(s, t);
        EXPECT_NEAR(strip.texel(row, column).solid_angle, static_cast<double>(exact),
                    1e-9 * static_cast<double>(exact));
      }
    }
  }
}

// The mirror ball's texels are all alike, 4 dA; the number of those in the disc is that of points
// of a lattice in a circle, pi n^2/4 + O(n). The angular density falls to 0 at the rim, as pi^2
// (1-r), so what the squares leave out there or have too much of, h wide, is O(h^2).
TEST(TexelGeometry, DiscsCoverNearlyTheSphere) {
  double before = 1.0;
  for (const int size : {16, 64, 256, 1024}) {
    const TexelGeometry ball = make(Layout::mirror_ball, size);
    const double h = 1.0 / size;
    EXPECT_NEAR(sum_of_solid_angles(ball), 16.0 * h * h * static_cast<double>(ball.texel_count()),
                1e-9);
    EXPECT_NEAR(sum_of_solid_angles(ball), 4.0 * kPi, 12.0 * std::pow(h, 1.5) * 4.0 * kPi) << size;
    const double miss = std::abs(sum_of_solid_angles(make(Layout::angular, size)) / (4 * kPi) - 1);
    EXPECT_LT(miss, 1.5 * h * h) << size;
    EXPECT_LT(miss, before);
    before = miss;
  }
}

// What lies outside is not in any span, by rows and by columns alike.
TEST(TexelGeometry, SpansAreTheSameByRowsAndByColumns) {
  for (const Layout layout : kAll) {
    for (const int edge : {1, 5, 12}) {
      const TexelGeometry geometry = make(layout, edge);
      std::set<std::pair<int, int>> by_rows, by_columns;
      for_each_texel(geometry, [&](int row, int column, const Texel& texel) {
        by_rows.emplace(row, column);
        EXPECT_NEAR(glm::length(texel.direction), 1.0, 1e-14);
      });
      for (int column = 0; column < geometry.width(); ++column) {
        const TexelLine upwards{geometry.height() - 1, column, -1, 0, geometry.height()};
        const TexelSpan span = geometry.span_of(upwards);
        for (int i = span.begin; i < span.end; ++i) {
          by_columns.emplace(upwards.row - i, column);
        }
      }
      EXPECT_EQ(by_rows, by_columns) << name_of(layout) << " " << edge;
      EXPECT_EQ(static_cast<std::int64_t>(by_rows.size()), geometry.texel_count());
    }
  }
}

// Six faces of 12 of a cross's texels; pi/4 of a square's, within its rim.
TEST(TexelGeometry, CountsTheTexelsThatShowSomething) {
  EXPECT_EQ(make(Layout::cube_vertical_cross, 8).texel_count(), 6 * 64);
  EXPECT_EQ(make(Layout::octahedral, 8).texel_count(), 64);
  const auto disc = static_cast<double>(make(Layout::angular, 512).texel_count());
  EXPECT_NEAR(disc, kPi / 4 * 512 * 512, 4 * 512);
}

// A line filled in either direction holds the texels one by one, as floats.
TEST(TexelGeometry, FillsLinesWithTheSameTexels) {
  for (const Layout layout : kAll) {
    const TexelGeometry geometry = make(layout, 6);
    const TexelLine lines[] = {{3, 0, 0, 1, geometry.width()},
                               {3, geometry.width() - 1, 0, -1, geometry.width()},
                               {geometry.height() - 1, 2, -1, 0, geometry.height()}};
    for (const TexelLine& line : lines) {
      const TexelSpan span = geometry.span_of(line);
      std::vector<float> x(span.size()), y(x), z(x), w(x);
      const double sum = geometry.fill(line, span, {x.data(), y.data(), z.data(), w.data()});
      double expected = 0.0;
      for (int i = 0; i < span.size(); ++i) {
        const int at = span.begin + i;
        const Texel texel =
            geometry.texel(line.row + at * line.row_step, line.column + at * line.column_step);
        expected += texel.solid_angle;
        EXPECT_EQ(glm::vec3(x[i], y[i], z[i]), glm::vec3(texel.direction));
        EXPECT_EQ(w[i], static_cast<float>(texel.solid_angle));
      }
      EXPECT_EQ(sum, expected);
    }
  }
}

// Where the middles of blocks and the edges of pictures look, as sphere/layout.h says it.
TEST(TexelGeometry, LiesAsThePanoramaDoes) {
  const auto looks = [](const TexelGeometry& geometry, int row, int column) {
    return geometry.texel(row, column).direction;
  };
  const auto expect_near = [](const glm::dvec3& a, const glm::dvec3& b, double most) {
    EXPECT_LT(glm::distance(a, b), most) << a.x << " " << a.y << " " << a.z;
  };
  const TexelGeometry cross = make(Layout::cube_vertical_cross, 3);
  expect_near(looks(cross, 1, 4), kUp, 1e-15);
  expect_near(looks(cross, 4, 1), -kRight, 1e-15);
  expect_near(looks(cross, 4, 4), kFront, 1e-15);
  expect_near(looks(cross, 4, 7), kRight, 1e-15);
  expect_near(looks(cross, 7, 4), -kUp, 1e-15);
  expect_near(looks(cross, 10, 4), -kFront, 1e-15);
  const TexelGeometry flat = make(Layout::cube_horizontal_cross, 3);
  expect_near(looks(flat, 4, 10), -kFront, 1e-15);
  expect_near(looks(flat, 4, 4), kFront, 1e-15);
  for (const Layout layout : {Layout::angular, Layout::mirror_ball}) {
    const TexelGeometry disc = make(layout, 501);
    expect_near(looks(disc, 250, 250), kFront, 1e-15);
    // A tenth of the radius: pi/10, or 2 asin(1/10).
    const double angle = layout == Layout::angular ? kPi * 50 / 250.5 : 2 * std::asin(50 / 250.5);
    expect_near(looks(disc, 250, 300), std::cos(angle) * kFront + std::sin(angle) * kRight, 1e-14);
    expect_near(looks(disc, 200, 250), std::cos(angle) * kFront + std::sin(angle) * kUp, 1e-14);
    expect_near(looks(disc, 250, 500), -kFront, 0.15);
  }
  for (const Layout layout : {Layout::octahedral, Layout::octahedral_equal_area}) {
    const TexelGeometry square = make(layout, 201);
    expect_near(looks(square, 100, 100), kUp, 1e-15);
    expect_near(looks(square, 100, 200), -kFront, 0.02);
    expect_near(looks(square, 200, 100), -kRight, 0.02);
    expect_near(looks(square, 0, 0), -kUp, 0.02);
  }
}

// Faces of a cross meet: texels on both sides of a seam look at most one texel's angle apart.
TEST(TexelGeometry, CrossesAreContinuous) {
  constexpr int kEdge = 16;
  for (const Layout layout : {Layout::cube_vertical_cross, Layout::cube_horizontal_cross}) {
    const TexelGeometry geometry = make(layout, kEdge);
    for_each_texel(geometry, [&](int row, int column, const Texel& texel) {
      const TexelSpan span = geometry.span_of({row, 0, 0, 1, geometry.width()});
      if (column + 1 < span.end) {
        EXPECT_LT(glm::distance(texel.direction, geometry.texel(row, column + 1).direction),
                  2.0 / kEdge);
      }
      const TexelSpan below = geometry.span_of({0, column, 1, 0, geometry.height()});
      if (row + 1 < below.end) {
        EXPECT_LT(glm::distance(texel.direction, geometry.texel(row + 1, column).direction),
                  2.0 / kEdge);
      }
    });
  }
}

// OpenEXR's border texels look exactly along the edges that two faces share.
TEST(TexelGeometry, OpenExrCubesShareTheirEdges) {
  const TexelGeometry cube = make(Layout::cube_openexr, 5);
  std::set<std::array<long, 3>> corners;
  for (int face = 0; face < kCubeFaceCount; ++face) {
    for (const int row : {0, 4}) {
      for (const int column : {0, 4}) {
        const glm::dvec3 at = cube.texel(5 * face + row, column).direction * std::sqrt(3.0);
        for (int axis = 0; axis < 3; ++axis) EXPECT_NEAR(std::abs(at[axis]), 1.0, 1e-14);
        corners.insert({std::lround(at.x), std::lround(at.y), std::lround(at.z)});
      }
    }
  }
  EXPECT_EQ(corners.size(), 8U);
}

}  // namespace
}  // namespace shoal
