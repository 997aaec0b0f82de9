#include "transform/map_synthesis.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "sphere/basis.h"
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

// The specification's table: the face's axis in front, and its edges meet those of its neighbours.
TEST(CubeDirection, PointsThroughTheFaces) {
  const glm::dvec3 axes[6] = {{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}};
  for (int face = 0; face < 6; ++face) {
    EXPECT_NEAR(glm::distance(cube_direction(face, 1, 0, 0), axes[face]), 0.0, 1e-15);
  }
  // Top left texels of a 2x2 face, from the table's (sc, tc, ma) with s = t = -1/2.
  const double n = 1.0 / std::sqrt(1.5);
  const glm::dvec3 corners[6] = {{n, n / 2, n / 2},   {-n, n / 2, -n / 2}, {-n / 2, n, -n / 2},
                                 {-n / 2, -n, n / 2}, {-n / 2, n / 2, n},  {n / 2, n / 2, -n}};
  for (int face = 0; face < 6; ++face) {
    EXPECT_NEAR(glm::distance(cube_direction(face, 2, 0, 0), corners[face]), 0.0, 1e-15) << face;
  }
}

}  // namespace
}  // namespace shoal
