#include "transform/hemisphere_integral.h"

#include <gmock/gmock.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

#include "core/row_band.h"
#include "sphere/direction_grid.h"
#include "sphere/irradiance_error.h"
#include "sphere/linear_operations.h"
#include "support/made_picture.h"
#include "support/temporary_folder.h"
#include "support/test_data.h"
#include "transform/projector.h"
#include "transform/simd_codecs.h"

namespace shoal {
namespace {

namespace fs = std::filesystem;
constexpr double kPi = std::numbers::pi;

std::vector<glm::dvec3> some_directions() {
  std::vector<glm::dvec3> directions = gauss_grid(6).directions;
  for (const glm::dvec3& n : {glm::dvec3(0, 0, 1), glm::dvec3(0, 0, -1), glm::dvec3(1, 0, 0),
                              glm::dvec3(0, -1, 0), glm::dvec3(-1, 0, 0)}) {
    directions.push_back(n);
  }
  return directions;
}

class HemisphereIntegral : public testing::Test {
 protected:
  fs::path write(const test::Picture& picture, const std::string& name = "picture.exr") {
    test::write_picture(picture, MapFormat::exr_float, folder_ / name);
    return folder_ / name;
  }

  static std::vector<glm::dvec3> integrate(const fs::path& path,
                                           std::span<const glm::dvec3> directions,
                                           const HemisphereSettings& settings = {}) {
    const auto source = open_panorama(path, {}, simd_chunk_codecs());
    EXPECT_TRUE(source) << source.error().text();
    const std::atomic<bool> stop{false};
    const auto irradiance = integrate_hemispheres(**source, directions, settings, stop);
    EXPECT_TRUE(irradiance) << irradiance.error().text();
    return *irradiance;
  }

  // Of degree 2 both ways: by Parseval to degree `quality_degree`, and by brute force over a grid
  // of so many rows.
  struct BothWays {
    IrradianceError parseval, measured;
  };
  static BothWays both_ways(const fs::path& path, int quality_degree, int rows) {
    ProjectionSettings settings;
    settings.quality_degree = quality_degree;
    settings.pixels.negative = PixelPolicy::Negative::zero;
    ProjectionTables tables;
    const auto projection = project_panorama(path, {}, settings, tables);
    EXPECT_TRUE(projection) << projection.error().text();
    HemisphereSettings hemisphere;
    hemisphere.pixels = settings.pixels;
    hemisphere.threads = 2;
    const DirectionGrid grid = gauss_grid(rows);
    const auto irradiance = integrate(path, grid.directions, hemisphere);
    return {*irradiance_error(projection->radiance, *projection->finer),
            *irradiance_error(projection->radiance, grid, irradiance)};
  }

  test::TemporaryFolder folder_;
};

// The integral of max(0, n.w) is pi for every n. The rows that the horizon touches, where the lit
// arc begins like a square root, leave an error of the row's height to the power 2.5.
TEST_F(HemisphereIntegral, OfAConstantIsPi) {
  for (const int height : {16, 64, 512}) {
    const auto path =
        write(test::make_picture(2 * height, height, [](int c, int, int) { return c + 1.0; }));
    const auto irradiance = integrate(path, some_directions());
    const double tolerance = 0.03 * std::pow(kPi / height, 2.5);
    for (const glm::dvec3& value : irradiance) {
      for (int c = 0; c < 3; ++c) EXPECT_NEAR(value[c], kPi * (c + 1), kPi * (c + 1) * tolerance);
    }
  }
}

// Light from the northern half alone: E = pi (1 + cos)/2, cos that of the angle to north (a form
// factor). Even heights have the border between rows.
TEST_F(HemisphereIntegral, OfHalfTheSphereIsItsFormFactor) {
  const auto path =
      write(test::make_picture(256, 128, [](int, int row, int) { return row < 64 ? 1.0 : 0.0; }));
  const std::vector<glm::dvec3> directions = some_directions();
  const auto irradiance = integrate(path, directions);
  for (std::size_t i = 0; i < directions.size(); ++i) {
    EXPECT_NEAR(irradiance[i].g, kPi * (1 + directions[i].z) / 2, 1e-5);
  }
}

// One bright texel, above, below and across the horizon, against the midpoint sum over 400 x 400
// parts of it, whose error across a horizon is of the order of a part's area.
TEST_F(HemisphereIntegral, OfOneTexelIsTheSumOverItsParts) {
  constexpr int kWidth = 16, kHeight = 8, kRow = 2, kColumn = 15, kParts = 400;
  const auto path = write(test::make_picture(kWidth, kHeight, [](int, int row, int column) {
    return row == kRow && column == kColumn ? 1.0 : 0.0;
  }));
  const std::vector<glm::dvec3> directions = some_directions();
  const auto irradiance = integrate(path, directions);
  for (std::size_t k = 0; k < directions.size(); ++k) {
    double sum = 0.0;
    for (int i = 0; i < kParts; ++i) {
      const double theta = kPi * (kRow + (i + 0.5) / kParts) / kHeight;
      for (int j = 0; j < kParts; ++j) {
        const double phi = 2 * kPi * (kColumn + (j + 0.5) / kParts) / kWidth;
        const glm::dvec3 w(std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi),
                           std::cos(theta));
        sum += std::max(0.0, glm::dot(directions[k], w)) * std::sin(theta);
      }
    }
    sum *= kPi / kHeight / kParts * 2 * kPi / kWidth / kParts;
    EXPECT_NEAR(irradiance[k].r, sum, 2e-5) << "of at most 0.15";
  }
}

TEST_F(HemisphereIntegral, TheSameBitsForEveryThreadCount) {
  const auto path = write(test::make_noisy_picture(40, 20, 5));
  const std::vector<glm::dvec3> directions = some_directions();
  const auto one = integrate(path, directions);
  for (const int threads : {2, 5}) {
    HemisphereSettings settings;
    settings.threads = threads;
    EXPECT_EQ(integrate(path, directions, settings), one);
  }
}

TEST_F(HemisphereIntegral, FollowsThePolicyAndTellsProgress) {
  auto picture = test::make_picture(16, 8, [](int, int, int) { return 1.0; });
  picture.at(1, 3, 4) = -5.0F;
  picture.at(0, 6, 2) = std::numeric_limits<float>::infinity();
  const auto source = open_panorama(write(picture), {}, simd_chunk_codecs());
  ASSERT_TRUE(source);
  const std::atomic<bool> stop{false};
  const std::vector<glm::dvec3> directions = {{0, 0, 1}};
  const auto refused = integrate_hemispheres(**source, directions, {}, stop);
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().code, ErrorCode::pixels);

  double last = 0.0;
  HemisphereSettings settings;
  settings.pixels.nonfinite = PixelPolicy::NonFinite::zero;
  settings.pixels.negative = PixelPolicy::Negative::zero;
  settings.progress = [&](double share) {
    EXPECT_GT(share, last);
    last = share;
  };
  const auto irradiance = integrate_hemispheres(**source, directions, settings, stop);
  ASSERT_TRUE(irradiance) << irradiance.error().text();
  EXPECT_EQ(last, 1.0);
  EXPECT_LT((*irradiance)[0].g, kPi) << "one texel of 112 above the horizon is black";
  EXPECT_NEAR((*irradiance)[0].b, kPi, 1e-3);

  const std::atomic<bool> stopped{true};
  const auto interrupted = integrate_hemispheres(**source, directions, settings, stopped);
  ASSERT_FALSE(interrupted);
  EXPECT_EQ(interrupted.error().code, ErrorCode::interrupted);
}

// What Parseval leaves out are the degrees above Q. Of a lone light they hold, of the squared error
// of degree 2, 128 (1 - sum_{l<=Q} of the energy of max(0, cos)): 1.45e-4 at Q = 64, so 7.3e-5 of
// the RMS, and 5.4e-4 at Q = 32, hence Q = 64; any other light is smoother. The grid's quadrature
// is exact for squares of degrees below its rows.
TEST_F(HemisphereIntegral, MeasuresTheErrorThatParsevalTells) {
  const auto noisy = write(test::make_noisy_picture(128, 64, 3), "noisy.exr");
  const auto smooth =
      write(test::make_picture(128, 64,
                               [](int c, int row, int column) {
                                 return 1.0 + (row < 20) * (c + 1) * 3.0 + std::sin(0.2 * column);
                               }),
            "smooth.exr");
  for (const auto& path : {noisy, smooth}) {
    const BothWays both = both_ways(path, 64, 129);
    EXPECT_NEAR(both.measured.relative_rms / both.parseval.relative_rms, 1.0, 1e-4);
    EXPECT_NEAR(both.measured.maximum, both.parseval.maximum,
                irradiance_beyond(64).maximum + 0.02 * both.parseval.maximum);
  }
}

// Nearly all light of some is their sun, whose irradiance has one sharp bend all around the sphere:
// its quadrature takes 129 rows of directions.
TEST_F(HemisphereIntegral, MeasuresTheErrorThatParsevalTellsOfRealPanoramas) {
  for (const std::string folder : {"pmndrs_hdr", "blender_exr"}) {
    SHOAL_REQUIRE_TEST_DATA(folder);
    for (const auto& entry : fs::directory_iterator(test::data_folder() / folder)) {
      const auto extension = entry.path().extension();
      if (extension != ".hdr" && extension != ".exr") continue;
      const BothWays both = both_ways(entry.path(), 64, 129);
      EXPECT_NEAR(both.measured.relative_rms / both.parseval.relative_rms, 1.0, 1e-4)
          << entry.path();
    }
  }
}

}  // namespace
}  // namespace shoal
