// Previews of pictures in every layout but equirect.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <glm/geometric.hpp>
#include <numbers>

#include "layout_list.h"
#include "sphere/texel_geometry.h"
#include "support/made_picture.h"
#include "support/temporary_folder.h"
#include "transform/preview.h"

namespace shoal {
namespace {

using test::kOneFile;
using test::Picture;

constexpr double kPi = std::numbers::pi;
const std::atomic<bool> kGoOn{false};

using Scene = std::function<double(const glm::dvec3&)>;

double smooth(const glm::dvec3& w) { return 2.0 + w.x + 0.7 * w.y * w.z - 0.5 * w.z; }

// What shows nothing holds what must not be seen.
Picture picture_of(Layout layout, int edge, const Scene& scene) {
  const LayoutSize size = size_of(layout, edge);
  const auto geometry = TexelGeometry::create(layout, size.width, size.height);
  EXPECT_TRUE(geometry);
  Picture picture(size.width, size.height);
  for (auto& plane : picture.planes) plane.assign(plane.size(), 1e30F);
  for (int row = 0; row < size.height; ++row) {
    const TexelSpan span = geometry->span_of({row, 0, 0, 1, size.width});
    for (int column = span.begin; column < span.end; ++column) {
      const double value = scene(geometry->texel(row, column).direction);
      for (int c = 0; c < 3; ++c) {
        picture.at(c, row, column) = static_cast<float>((c + 1) * value);
      }
    }
  }
  return picture;
}

Preview preview_of(const Picture& picture, Layout layout, int width) {
  const test::TemporaryFolder folder;
  test::write_picture(picture, MapFormat::exr_float, folder / "a.exr");
  auto preview = make_preview(folder / "a.exr", {}, {width, layout}, kGoOn);
  EXPECT_TRUE(preview) << preview.error().text();
  return preview ? *preview : Preview();
}

glm::dvec3 direction_of(const Preview& preview, int row, int column) {
  const double theta = kPi * (row + 0.5) / preview.height;
  const double phi = 2 * kPi * (column + 0.5) / preview.width;
  return {std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi), std::cos(theta)};
}

// The greatest difference from the scene, but for 0.35 radians about the direction behind, of which
// a disc's rim shows little.
double largest_error(const Preview& preview, const Scene& scene) {
  double largest = 0.0;
  for (int row = 0; row < preview.height; ++row) {
    for (int column = 0; column < preview.width; ++column) {
      const glm::dvec3 w = direction_of(preview, row, column);
      if (w.x > std::cos(0.35)) continue;
      for (int c = 0; c < 3; ++c) {
        const double error = preview.planes[c][row * preview.width + column] / (c + 1.0) - scene(w);
        largest = std::max(largest, std::abs(error));
      }
    }
  }
  return largest;
}

double light_of(const Preview& preview) {
  double sum = 0.0;
  for (int row = 0; row < preview.height; ++row) {
    const double solid_angle = 2 * kPi / preview.width * 2 * std::sin(kPi / (2 * preview.height)) *
                               std::sin(kPi * (row + 0.5) / preview.height);
    for (int column = 0; column < preview.width; ++column) {
      sum += solid_angle * preview.planes[0][row * preview.width + column];
    }
  }
  return sum;
}

// A scene lies where it lies in any layout. Means over a texel of side h of what bends by at most
// b = 3 are off by h^2/24 b for each angle, and so are those of the smaller picture, half as large,
// and what is interpolated in it by h^2/8 b/4 for each, but along the edges of squares, where
// it is held: there by h/4 times the slope, at most 1.6, and half as much again where an equal-area
// octahedron's texels are drawn out.
TEST(LayoutPreview, LiesAsTheSceneDoes) {
  for (const Layout layout : kOneFile) {
    const Picture picture = picture_of(layout, 128, smooth);
    for (const int width : {16, 32, 64}) {
      const Preview preview = preview_of(picture, layout, width);
      ASSERT_EQ(preview.width, width);
      ASSERT_EQ(preview.height, width / 2);
      EXPECT_EQ(preview.layout, layout);
      const double h = 2 * kPi / width;
      EXPECT_LT(largest_error(preview, smooth), h / 4 * 1.6 * 1.5)
          << name_of(layout) << " " << width;
    }
  }
}

// Nothing that the picture does not show comes into a preview of it, of any ratio of sizes, and it
// is never larger than the picture.
TEST(LayoutPreview, OfAConstantIsTheConstant) {
  for (const Layout layout : kOneFile) {
    for (const int edge : {1, 7, 48, 100}) {
      const Preview preview =
          preview_of(picture_of(layout, edge, [](const glm::dvec3&) { return 3.0; }), layout, 50);
      EXPECT_LE(preview.width, std::min(50, 4 * edge)) << name_of(layout);
      EXPECT_THAT(preview.planes[0], testing::Each(testing::FloatNear(3.0F, 1e-5F)))
          << name_of(layout) << " " << edge;
    }
  }
}

// A small sun of 1000 times the sky, far brighter than any texel of the preview, keeps its light:
// of the smaller picture's texels each has about the same weight, to a few percent for how they
// vary in size.
TEST(LayoutPreview, KeepsASunsLight) {
  const glm::dvec3 sun = glm::normalize(glm::dvec3(-0.7, 0.2, 0.4));
  const Scene scene = [&](const glm::dvec3& w) { return glm::dot(w, sun) > 0.9995 ? 1001.0 : 1.0; };
  const double expected = 4 * kPi + 1000.0 * 2 * kPi * 0.0005;
  for (const Layout layout : kOneFile) {
    const Picture picture = picture_of(layout, 256, scene);
    for (const int width : {33, 64, 120}) {
      const Preview preview = preview_of(picture, layout, width);
      EXPECT_NEAR(light_of(preview), expected, 0.05 * expected) << name_of(layout) << " " << width;
    }
  }
}

TEST(LayoutPreview, RefusesASizeThatTheLayoutDoesNotHave) {
  const test::TemporaryFolder folder;
  test::write_picture(test::make_noisy_picture(64, 32, 6), MapFormat::hdr, folder / "a.hdr");
  const auto preview = make_preview(folder / "a.hdr", {}, {20, Layout::angular}, kGoOn);
  ASSERT_FALSE(preview);
  EXPECT_EQ(preview.error().where, (folder / "a.hdr").string());
  EXPECT_THAT(preview.error().what, testing::HasSubstr("64 x 32"));
}

// What is guessed is told.
TEST(LayoutPreview, TakesWhatItIsNotToldByTheAspect) {
  const Picture picture = picture_of(Layout::cube_vertical_cross, 16, smooth);
  const Preview preview = preview_of(picture, Layout::automatic, 32);
  EXPECT_EQ(preview.layout, Layout::cube_vertical_cross);
  EXPECT_THAT(preview.warnings, testing::ElementsAre(testing::HasSubstr("aspect is 3:4")));
}

}  // namespace
}  // namespace shoal
