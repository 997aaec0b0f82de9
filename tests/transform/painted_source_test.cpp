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
  return project(painted(painting_of(std::span(&light, 1), 2 * height, height)), degree).radiance;
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
  return {"sky", width, height, [model](const glm::dvec3& d) { return model->radiance(d); },
          {},    {}};
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

// A disk keeps its flux, the coefficient of degree 0, at any size of the picture: a tenth of a
// texel or a thousand of them, over a pole, across the seam. Floats round by 6e-8 and the kernel's
// sums by 1e-6 of the light.
// Its direction is right to the texels' averages. What one texel holds is moved by at most half its
// diagonal, whose length at the equator is pi/height sqrt(2), so that degree 1, which is sqrt(3)
// times as long as degree 0, is off by no more: the first order, for a disk within a texel. Of a
// larger one only the texels on its edge are moved, each a part of 1/r of it, and to either side:
// at r texels or more the error is a quarter of that.
TEST(PaintedSource, DisksKeepTheirFlux) {
  for (const double elevation : {-90.0, -80.0, 5.0, 30.0, 89.9}) {
    for (const double azimuth : {-53.0, 0.0, 180.0}) {
      for (const double radius : {1e-5, 1e-3, 0.00465, 0.02, 0.2}) {
        const double t = elevation * kPi / 180, p = azimuth * kPi / 180;
        const AnalyticLight light = DiskLight{
            {std::cos(t) * std::cos(p), std::cos(t) * std::sin(p), std::sin(t)}, radius, kColour};
        const Coefficients exact = project_lights(std::span(&light, 1), 1);
        for (const int height : {3, 8, 64, 256}) {
          const Coefficients got = projected(light, height, 1);
          for (int c = 0; c < kChannelCount; ++c) {
            const double flux = exact.channels[c][0];
            EXPECT_NEAR(got.channels[c][0], flux, 1e-6 * flux)
                << elevation << " " << azimuth << " " << radius << " " << height;
          }
          const double half_diagonal = kPi / height / std::sqrt(2.0);
          const double part = radius > 2 * kPi / height ? 0.25 : 1.0;
          EXPECT_LT(distance(got, exact), part * std::sqrt(3.0) / 2 * half_diagonal);
        }
      }
    }
  }
}

// A directional light has exactly its flux, too; and each coefficient is the bilinear interpolation
// of Y_lm's averages over texels of side h. Along either angle a harmonic of degree l bends by at
// most l^2 of its size, so that interpolation is off by h^2/8 l^2, over a pole, where texels' mean
// angles are 4/3 h apart, by h^2/4.5 l^2; averages by h^2/24 l^2 for each angle: together less than
// h^2 l^2/2. That this order is reached is seen in the mean over directions, of which some lie on
// a texel's centre, where nothing is interpolated.
TEST(PaintedSource, DirectionalLightsConvergeAtTheSecondOrder) {
  constexpr int kDegree = 6;
  const std::vector<glm::dvec3> directions = {
      kAxis,        {1, 0, 0},         {0, 0, 1},     {0, 0, -1},        {1, -1e-3, 0.2},
      {-3, 2, 0.5}, {0.01, 0.02, 1.0}, {0.3, 1, -20}, {-0.4, -0.6, 0.1}, {1e-9, 0, 5}};
  double mean_before = 0.0;
  for (const int height : {16, 32, 64, 128}) {
    const double h = kPi / height;
    double mean = 0.0;
    for (const glm::dvec3& direction : directions) {
      const AnalyticLight light = DirectionalLight{direction, kColour};
      const Coefficients exact = project_lights(std::span(&light, 1), kDegree);
      const Coefficients got = projected(light, height, kDegree);
      for (int c = 0; c < kChannelCount; ++c) {
        EXPECT_NEAR(got.channels[c][0], exact.channels[c][0], 1e-6 * exact.channels[c][0]);
      }
      const double error = distance(got, exact);
      EXPECT_LT(error, h * h * kDegree * kDegree / 2) << height << " " << direction.x;
      mean += error / static_cast<double>(directions.size());
    }
    if (mean_before > 0.0) {
      EXPECT_GT(mean_before / mean, 3.0) << height;
      EXPECT_LT(mean_before / mean, 5.0) << height;
    }
    mean_before = mean;
  }
}

// Pictures of one texel and of odd widths have poles as well.
TEST(PaintedSource, DirectionalLightsFitIntoAnyPicture) {
  for (const auto& [width, height] : {std::pair(1, 1), {2, 1}, {5, 2}, {7, 3}}) {
    for (const glm::dvec3& direction : {glm::dvec3(0, 0, 1), glm::dvec3(-1, 0.1, -2)}) {
      const AnalyticLight light = DirectionalLight{direction, kColour};
      const auto painting = painting_of(std::span(&light, 1), width, height);
      const Coefficients got = project(painted(painting), 0).radiance;
      const Coefficients exact = project_lights(std::span(&light, 1), 0);
      EXPECT_LT(distance(got, exact), 1e-6) << width << " x " << height;
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
    painting.directional = {DirectionalLight{{1, 2, 3}, kColour}};
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
  EXPECT_FALSE(paint(sky_painting(0, 8)));
  EXPECT_FALSE(paint(sky_painting(16, -1)));
  EXPECT_FALSE(paint(sky_painting(kMaxSide, kMaxSide)));
}

}  // namespace
}  // namespace shoal
