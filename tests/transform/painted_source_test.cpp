#include "transform/painted_source.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <thread>

#include "sphere/linear_operations.h"
#include "sphere/preetham_sky.h"
#include "support/temporary_folder.h"
#include "transform/projector.h"

namespace shoal {
namespace {

constexpr double kPi = std::numbers::pi;
const glm::dvec3 kAxis(0.3, -1.2, 0.7);
const glm::dvec3 kColour(1.0, 0.5, 2.0);

std::unique_ptr<PanoramaSource> painted(Painting painting) {
  auto source = paint(std::move(painting));
  EXPECT_TRUE(source) << source.error().text();
  return std::move(source).value();
}

Projection project(std::unique_ptr<PanoramaSource> source, int degree, int workers = 1,
                   std::vector<AnalyticLight> lights = {}) {
  ProjectionTables tables;
  ProjectionSettings settings;
  settings.degree = degree;
  const auto projection = PanoramaProjection::open(
      PaintedPanorama{"painted", std::move(source), std::move(lights)}, settings, tables);
  const std::atomic<bool> stop{false};
  std::atomic<std::int64_t> pixels{0};
  std::vector<std::thread> threads;
  for (int i = 0; i < workers; ++i) {
    threads.emplace_back([&] { EXPECT_TRUE(projection->work(stop, pixels)); });
  }
  for (std::thread& thread : threads) thread.join();
  auto result = projection->finish();
  EXPECT_TRUE(result) << result.error().text();
  return std::move(result).value();
}

Coefficients projected(const AnalyticLight& light, int height, int degree) {
  auto painting = painting_of(std::span(&light, 1), 2 * height, height);
  EXPECT_TRUE(painting) << painting.error().text();
  return project(painted(std::move(*painting)), degree).radiance;
}

// The L2 distance of all coefficients, relative to the length of `b`.
double distance(const Coefficients& a, const Coefficients& b) {
  double difference = 0.0, length = 0.0;
  for (int c = 0; c < kChannelCount; ++c) {
    for (std::size_t i = 0; i < a.channels[c].size(); ++i) {
      difference += std::pow(a.channels[c][i] - b.channels[c][i], 2);
      length += std::pow(b.channels[c][i], 2);
    }
  }
  return std::sqrt(difference / length);
}

PreethamSky afternoon() { return {3.0, 30.0, 90.0, glm::dvec3(0.2)}; }

Painting sky_painting(int width, int height) {
  auto model = std::make_shared<const PreethamModel>(afternoon());
  return {"sky", width, height, [model](const glm::dvec3& d) { return model->radiance(d); }, {}};
}

// Pixels against closed forms. Averages over texels leave out what changes within one: an error of
// the second order in the texel's side for a smooth Y_lm, also along edges, of whose texels there
// are 1/h with h^2 of area each, wrong by h. So twice the size makes a quarter of the error; a
// factor of 3 is asked for, since edges lie differently in every grid.
TEST(PaintedSource, LightsAgreeWithTheirClosedForms) {
  const AnalyticLight lights[] = {DiskLight{kAxis, kPi / 2, kColour},
                                  DiskLight{kAxis, 0.6, kColour}, DiskLight{kAxis, 2.5, kColour},
                                  CosineLobe{kAxis, kColour}};
  for (const AnalyticLight& light : lights) {
    const Coefficients exact = project_lights(std::span(&light, 1), 6);
    double before = distance(projected(light, 16, 6), exact);
    EXPECT_LT(before, 0.05);
    for (const int height : {32, 64}) {
      const double error = distance(projected(light, height, 6), exact);
      EXPECT_LT(error, before / 3) << light.index() << " " << height;
      before = error;
    }
  }
  // Nothing to be averaged: to the rounding of float samples and of the kernel's sums.
  const AnalyticLight ambient = AmbientLight{kColour};
  EXPECT_LT(distance(projected(ambient, 16, 6), project_lights(std::span(&ambient, 1), 6)), 1e-7);
}

// A sun keeps its light at any size of the picture: its flux, the coefficient of degree 0, to 0.1 %
// where it covers parts of texels, to float's rounding where it is given to one; and its direction
// to half a texel.
TEST(PaintedSource, SmallSunsKeepTheirLight) {
  for (const double elevation : {-80.0, 5.0, 30.0, 89.9}) {
    for (const double radius : {1e-7, 1e-4, 0.00465, 0.02}) {
      const double t = elevation * kPi / 180;
      const DiskLight sun{{std::cos(t) * 0.6, std::cos(t) * -0.8, std::sin(t)}, radius, kColour};
      const AnalyticLight light = sun;
      const Coefficients exact = project_lights(std::span(&light, 1), 1);
      for (const int height : {3, 8, 64, 256}) {
        const Coefficients got = projected(light, height, 1);
        for (int c = 0; c < kChannelCount; ++c) {
          const double flux = exact.channels[c][0];
          EXPECT_NEAR(got.channels[c][0], flux, 2e-3 * flux) << elevation << " " << height;
        }
        // sqrt(3) is the ratio of the lengths of degrees 1 and 0 of a direction.
        const double half_diagonal = kPi / height / std::sqrt(2.0);
        EXPECT_LT(distance(got, exact), std::sqrt(3.0) / 2 * half_diagonal + 3e-3);
      }
    }
  }
}

// Elevation 30 is a third of the way down, azimuth 90 a quarter of the width right of the centre.
TEST(PaintedSource, TheSkyIsUprightAndItsSunInPlace) {
  Painting painting = sky_painting(360, 180);
  painting.disks.push_back(PreethamModel(afternoon()).sun());
  const auto source = painted(std::move(painting));
  const auto reader = source->new_reader();
  float brightest = 0.0F;
  int at_row = 0, at_column = 0;
  std::vector<double> row_luminance(180);
  for (int band_index = 0; band_index < source->info().band_count; ++band_index) {
    const auto band = (*reader)->read(band_index);
    for (int i = 0; i < band->row_count(); ++i) {
      const auto* green = reinterpret_cast<const float*>(band->channels[1].row(i));
      for (int j = 0; j < 360; ++j) {
        row_luminance[band->row_begin + i] += green[j] / 360;
        if (green[j] <= brightest) continue;
        brightest = green[j];
        at_row = band->row_begin + i;
        at_column = j;
      }
    }
  }
  // The disk lies on the corner of four texels.
  EXPECT_TRUE(at_row == 59 || at_row == 60) << at_row;
  EXPECT_TRUE(at_column == 269 || at_column == 270) << at_column;
  // Ground below, the same everywhere, and the sky above.
  for (int row = 91; row < 180; ++row) EXPECT_EQ(row_luminance[row], row_luminance[90]);
  EXPECT_NE(row_luminance[89], row_luminance[90]);
}

// Of the fine picture, which is itself off by a 64th of the coarsest one's error.
TEST(PaintedSource, SkiesConverge) {
  const Coefficients fine = project(painted(sky_painting(1024, 512)), 4).radiance;
  double before = distance(project(painted(sky_painting(32, 16)), 4).radiance, fine);
  EXPECT_LT(before, 0.01);
  for (const int height : {32, 64, 128}) {
    const double error =
        distance(project(painted(sky_painting(2 * height, height)), 4).radiance, fine);
    EXPECT_LT(error, before / 3) << height;
    before = error;
  }
}

TEST(PaintedSource, TheSameBitsForAnyNumberOfWorkers) {
  const auto source = [] {
    Painting painting = sky_painting(200, 101);
    painting.disks = {DiskLight{kAxis, 0.01, kColour}, DiskLight{-kAxis, 1.0, kColour}};
    return painted(std::move(painting));
  };
  const Coefficients alone = project(source(), 10).radiance;
  EXPECT_EQ(project(source(), 10, 3).radiance, alone);
  EXPECT_EQ(project(source(), 10, 8).radiance, alone);
}

// Lights in closed form are added to what the pixels give, bit by bit.
TEST(PaintedSource, LightsBesideThePixelsAreExact) {
  const std::vector<AnalyticLight> lights{PreethamModel(afternoon()).sun(),
                                          DirectionalLight{kAxis, kColour}};
  const Coefficients sky = project(painted(sky_painting(64, 32)), 5).radiance;
  const Coefficients both = project(painted(sky_painting(64, 32)), 5, 1, lights).radiance;
  EXPECT_EQ(both, add(sky, project_lights(lights, 5)));
}

// A picture in float reads back as the very samples that were painted.
TEST(PaintedSource, PicturesReadBackAsTheyWerePainted) {
  test::TemporaryFolder folder;
  const auto path = folder / "sky.exr";
  MapFile file;
  file.format = MapFormat::exr_float;
  file.width = 100;
  file.height = 37;
  ASSERT_TRUE(write_picture(*painted(sky_painting(100, 37)), path, file));
  ProjectionTables tables;
  ProjectionSettings settings;
  settings.degree = 5;
  const auto read = project_panorama(path, {}, settings, tables);
  ASSERT_TRUE(read) << read.error().text();
  EXPECT_EQ(read->radiance, project(painted(sky_painting(100, 37)), 5).radiance);
}

TEST(PaintedSource, RefusesWhatCannotBePainted) {
  const AnalyticLight sun = DirectionalLight{kAxis, kColour};
  const auto painting = painting_of(std::span(&sun, 1), 16, 8);
  ASSERT_FALSE(painting);
  EXPECT_EQ(painting.error().what, "a directional light has no picture");
  EXPECT_FALSE(paint(sky_painting(0, 8)));
  EXPECT_FALSE(paint(sky_painting(16, -1)));
  EXPECT_FALSE(paint(sky_painting(kMaxSide, kMaxSide)));
}

}  // namespace
}  // namespace shoal
