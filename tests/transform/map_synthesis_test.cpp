#include "transform/map_synthesis.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "sphere/basis.h"
#include "sphere/texel_mappings.h"
#include "support/random_numbers.h"
#include "support/temporary_folder.h"
#include "transform/projector.h"

namespace shoal {
namespace {

constexpr double kPi = std::numbers::pi;

Coefficients random_coefficients(int degree, std::uint64_t seed) {
  test::RandomNumbers random(seed);
  Coefficients coefficients(degree);
  for (auto& channel : coefficients.channels) {
    for (double& value : channel) value = random.between(-1.0, 1.0);
  }
  return coefficients;
}

TEST(EquirectSynthesis, IsTheSumOfTheBasisAtEveryPixelCentre) {
  const int degree = 6;
  const Coefficients coefficients = random_coefficients(degree, 1);
  for (const auto& [width, height] : {std::pair{40, 20}, {65, 33}, {128, 64}, {1, 1}}) {
    EquirectSynthesis synthesis(width, height, degree);
    std::array<std::vector<float>, 3> rows;
    for (auto& row : rows) row.resize(width);
    for (int i = 0; i < height; ++i) {
      synthesis.row(coefficients, i, {rows[0].data(), rows[1].data(), rows[2].data()});
      for (int j = 0; j < width; ++j) {
        const double theta = kPi * (i + 0.5) / height;
        const double phi = 2.0 * kPi * (j + 0.5) / width;
        const glm::dvec3 exact =
            evaluate(coefficients, glm::dvec3(std::sin(theta) * std::cos(phi),
                                              std::sin(theta) * std::sin(phi), std::cos(theta)));
        // (2L+4) u of the row's moments, which are at most a few tens here.
        for (int c = 0; c < 3; ++c) EXPECT_NEAR(rows[c][j], exact[c], 3e-5);
      }
    }
  }
}

// Projecting a map gives back the coefficients it was made of: Fejer's rule is exact for it.
TEST(EquirectMap, ComesBackAsItsCoefficients) {
  const test::TemporaryFolder folder;
  const int degree = 8;
  const Coefficients coefficients = random_coefficients(degree, 2);
  MapFile file;
  file.format = MapFormat::exr_float;
  file.width = 64;
  file.height = 32;
  ASSERT_TRUE(write_equirect_map(coefficients, folder / "map.exr", file));
  ProjectionSettings settings;
  settings.degree = degree;
  settings.quadrature = Quadrature::fejer;
  ProjectionTables tables;
  const auto result = project_panorama(folder / "map.exr", {}, settings, tables);
  ASSERT_TRUE(result) << result.error().text();
  for (int c = 0; c < 3; ++c) {
    for (int i = 0; i < coefficient_count(degree); ++i) {
      EXPECT_NEAR(result->radiance.channels[c][i], coefficients.channels[c][i], 1e-5);
    }
  }
}

double largest_difference(const Coefficients& a, const Coefficients& b) {
  double largest = 0.0;
  for (int c = 0; c < 3; ++c) {
    for (std::size_t i = 0; i < a.channels[c].size(); ++i) {
      largest = std::max(largest, std::abs(a.channels[c][i] - b.channels[c][i]));
    }
  }
  return largest;
}

MapFile map_file(Layout layout, int edge) {
  MapFile file;
  file.format = MapFormat::exr_float;
  const LayoutSize size = size_of(layout, edge);
  file.width = size.width;
  file.height = layout == Layout::cube_faces ? edge : size.height;
  return file;
}

Coefficients read_back(const std::filesystem::path& path, Layout layout, int degree) {
  ProjectionSettings settings;
  settings.degree = degree;
  settings.layout = layout;
  ProjectionTables tables;
  const auto result = project_panorama(path, {}, settings, tables);
  EXPECT_TRUE(result) << result.error().text();
  return result ? result->radiance : Coefficients(degree);
}

// What a map is read back as is what it was made of, within the midpoint rule's O(h^2) (on a mirror
// ball h^(3/2)): h = 2/96, degree 4, coefficients to 1.
TEST(LayoutMap, ComesBackAsItsCoefficients) {
  const test::TemporaryFolder folder;
  const Coefficients light = random_coefficients(4, 3);
  for (const Layout layout :
       {Layout::cube_vertical_cross, Layout::cube_horizontal_cross, Layout::cube_vertical_strip,
        Layout::cube_horizontal_strip, Layout::angular, Layout::mirror_ball, Layout::octahedral,
        Layout::octahedral_equal_area}) {
    const auto path = folder / "map.exr";
    ASSERT_TRUE(write_layout_map(light, layout, 0, path, map_file(layout, 96)));
    const double most = layout == Layout::mirror_ball ? 0.05 : 0.01;
    EXPECT_LT(largest_difference(read_back(path, layout, 4), light), most) << name_of(layout);
  }
}

// A cube whose faces are named by the axes of a frame: read as cubes are, by the axes of
// cube_frame(), its coefficients in that frame are those of the light in the other one.
TEST(LayoutMap, NamesTheFacesOfACubeByTheFrame) {
  const test::TemporaryFolder folder;
  const Coefficients light = random_coefficients(3, 4);
  for (const char* name : {"native", "openexr", "cmft", "three", "materialx"}) {
    const Frame frame = *parse_frame(name);
    const std::string_view ends[] = {"px", "nx", "py", "ny", "pz", "nz"};
    for (int face = 0; face < 6; ++face) {
      ASSERT_TRUE(write_layout_map(facing(light, frame), Layout::cube_faces, face,
                                   folder / ("map_" + std::string(ends[face]) + ".exr"),
                                   map_file(Layout::cube_faces, 64)));
    }
    const Coefficients back = read_back(folder / "map_px.exr", Layout::cube_faces, 3);
    EXPECT_LT(largest_difference(to_frame(back, cube_frame()), to_frame(light, frame)), 0.01)
        << name;
  }
}

// The specification's table: the face's axis in front, and of the corner texel of 2 x 2 ones, from
// (sc, tc, ma) with s = t = -1/2. A light that is x, y and z in its channels shows directions.
TEST(LayoutMap, LaysCubesOutAsOpenGl) {
  const glm::dvec3 axes[6] = {{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}};
  const glm::dvec3 corners[6] = {{1, .5, .5},   {-1, .5, -.5}, {-.5, 1, -.5},
                                 {-.5, -1, .5}, {-.5, .5, 1},  {.5, .5, -1}};
  for (int face = 0; face < 6; ++face) {
    const CubeFace axis = cube_face(face);
    EXPECT_EQ(axis.centre, axes[face]);
    EXPECT_EQ(axis.centre - 0.5 * axis.right - 0.5 * axis.down, corners[face]) << face;
  }
}

}  // namespace
}  // namespace shoal
