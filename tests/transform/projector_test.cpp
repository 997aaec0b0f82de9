#include "transform/projector.h"

#include <gmock/gmock.h>

#include <cmath>
#include <numbers>
#include <thread>

#include "sphere/basis.h"
#include "sphere/irradiance.h"
#include "support/every_target.h"
#include "support/made_picture.h"
#include "support/temporary_folder.h"
#include "transform/moment_table.h"

namespace shoal {
namespace {

using test::Picture;

constexpr double kPi = std::numbers::pi;

Projection project(const std::filesystem::path& path, const ProjectionSettings& settings,
                   const ReadOptions& options = {}) {
  ProjectionTables tables;
  auto result = project_panorama(path, options, settings, tables);
  EXPECT_TRUE(result) << result.error().text();
  return result ? std::move(result).value() : Projection{};
}

ProjectionSettings settings_of(int degree, Quadrature quadrature,
                               Arithmetic arithmetic = Arithmetic::kernels) {
  ProjectionSettings settings;
  settings.degree = degree;
  settings.quadrature = quadrature;
  settings.arithmetic = arithmetic;
  return settings;
}

class Projector : public testing::Test {
 protected:
  std::filesystem::path write(const Picture& picture, MapFormat format, const std::string& name) {
    const auto path = folder_ / (name + (format == MapFormat::hdr ? ".hdr" : ".exr"));
    test::write_picture(picture, format, path);
    return path;
  }

  test::TemporaryFolder folder_;
};

// Integral of c Y_lm = c sqrt(4 pi) delta_l0, since Y_00 = 1/sqrt(4 pi) and the basis is
// orthogonal. By the kernels the table of cosines and the sums are rounded in single precision:
// 1e-7.
TEST_F(Projector, GivesAConstantPictureItsMeanAlone) {
  for (const double value : {1.0, 0.1, 3.7, 1e-3, 1e4}) {
    const auto path = write(test::make_picture(96, 48, [&](int, int, int) { return value; }),
                            MapFormat::exr_float, "constant");
    for (const Quadrature quadrature : {Quadrature::texel, Quadrature::fejer}) {
      for (const Arithmetic arithmetic : {Arithmetic::kernels, Arithmetic::reference}) {
        const double tolerance = arithmetic == Arithmetic::kernels ? 1e-7 : 1e-13;
        const Projection result = project(path, settings_of(10, quadrature, arithmetic));
        const double l00 = std::sqrt(4.0 * kPi) * static_cast<double>(static_cast<float>(value));
        for (const auto& channel : result.radiance.channels) {
          EXPECT_NEAR(channel[0], l00, tolerance * l00);
          for (std::size_t i = 1; i < channel.size(); ++i) {
            EXPECT_NEAR(channel[i], 0.0, tolerance * l00) << "index " << i;
          }
        }
        // And so its irradiance is pi times its radiance, whichever way a surface faces.
        const Coefficients irradiance = apply_quantity(result.radiance, Quantity::irradiance);
        for (const glm::dvec3 n :
             {glm::dvec3(0, 0, 1), glm::dvec3(1, 0, 0), glm::dvec3(0, -1, 0)}) {
          EXPECT_NEAR(evaluate(irradiance, n).g / (kPi * static_cast<float>(value)), 1.0,
                      arithmetic == Arithmetic::kernels ? 2e-6 : 1e-12);
        }
      }
    }
  }
}

// Fejer's rule is exact for products up to degree H-1, so the samples of Y_lm give delta_lm: the
// error is that of the picture's own floats and of the kernel, both relative to the integral of
// Y_lm^2 <= 1.
TEST_F(Projector, FindsEachBasisFunctionAloneWithFejer) {
  constexpr int kDegree = 10;
  constexpr int kWidth = 64;
  constexpr int kHeight = 32;
  const Basis<double> basis(kDegree);
  std::vector<double> values(coefficient_count(kDegree));
  for (int l = 0; l <= kDegree; ++l) {
    for (int m = -l; m <= l; ++m) {
      const Picture picture = test::make_picture(kWidth, kHeight, [&](int, int i, int j) {
        const double theta = kPi * (i + 0.5) / kHeight;
        const double phi = 2.0 * kPi * (j + 0.5) / kWidth;
        basis.evaluate(
            {std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi), std::cos(theta)},
            values);
        return values[coefficient_index(l, m)];
      });
      const auto path = write(picture, MapFormat::exr_float, "basis");
      const Projection result = project(path, settings_of(kDegree, Quadrature::fejer));
      for (int i = 0; i < coefficient_count(kDegree); ++i) {
        EXPECT_NEAR(result.radiance.channels[1][i], i == coefficient_index(l, m) ? 1.0 : 0.0, 1e-6)
            << "l " << l << " m " << m << " index " << i;
      }
    }
  }
}

// The promise of projector.h: |dL_lm| <= 1e-6 of the integral of |I Y_lm|, which is taken here as
// the double sum over |I| |Y_lm| sin(theta) dtheta dphi.
TEST_F(Projector, StaysWithinItsBoundOfTheTwin) {
  struct Case {
    int width, height, degree;
    Quadrature quadrature;
  };
  for (const Case& c :
       {Case{64, 32, 2, Quadrature::texel}, Case{64, 32, 64, Quadrature::texel},
        Case{67, 33, 10, Quadrature::texel}, Case{100, 60, 10, Quadrature::midpoint},
        Case{128, 64, 10, Quadrature::fejer}, Case{5, 3, 10, Quadrature::texel},
        Case{1, 1, 4, Quadrature::texel}, Case{64, 1, 2, Quadrature::texel}}) {
    const Picture picture = test::make_noisy_picture(c.width, c.height, c.width);
    const auto path = write(picture, MapFormat::exr_float, "noisy");
    const Projection fast = project(path, settings_of(c.degree, c.quadrature));
    const Projection slow =
        project(path, settings_of(c.degree, c.quadrature, Arithmetic::reference));
    const Basis<double> basis(c.degree);
    std::vector<double> values(coefficient_count(c.degree));
    std::vector<double> bound(values.size());
    for (int i = 0; i < c.height; ++i) {
      for (int j = 0; j < c.width; ++j) {
        const double theta = kPi * (i + 0.5) / c.height;
        const double phi = 2.0 * kPi * (j + 0.5) / c.width;
        const double weight = std::sin(theta) * kPi / c.height * 2.0 * kPi / c.width;
        basis.evaluate(
            {std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi), std::cos(theta)},
            values);
        for (std::size_t k = 0; k < values.size(); ++k) {
          bound[k] += weight * std::abs(values[k] * picture.at(0, i, j));
        }
      }
    }
    for (std::size_t k = 0; k < bound.size(); ++k) {
      // A picture of one column or row has basis functions that vanish at its pixel centres but not
      // over its texels; there the bound is relative to the picture's light.
      const double scale = std::max(bound[k], c.width < 64 || c.height < 32 ? bound[0] : 0.0);
      // The second term: orders whose cosine is zero at every pixel centre but for the rounding of
      // pi.
      EXPECT_NEAR(fast.radiance.channels[0][k], slow.radiance.channels[0][k],
                  1e-6 * scale + 1e-14 * bound[0])
          << c.width << "x" << c.height << " index " << k;
    }
  }
}

TEST_F(Projector, GivesTheSameBitsForEveryTargetThreadCountAndBandHeight) {
  for (const MapFormat format : {MapFormat::exr_half, MapFormat::exr_float, MapFormat::hdr}) {
    for (const int width : {33, 64, 67, 1024}) {
      const auto path = write(test::make_noisy_picture(width, 80, 5), format, "same");
      const ProjectionSettings settings = settings_of(10, Quadrature::texel);
      const Coefficients first = project(path, settings).radiance;
      test::for_every_target([&] {
        for (const int band_rows : {0, 1, 7, 16, 100}) {
          ReadOptions options;
          options.rows_per_band = band_rows;
          for (const int threads : {1, 2, 7}) {
            ProjectionTables tables;
            auto projection = PanoramaProjection::open(path, options, settings, tables);
            ASSERT_TRUE(projection) << projection.error().text();
            const std::atomic<bool> stop{false};
            std::atomic<std::int64_t> pixels{0};
            {
              std::vector<std::jthread> workers;
              for (int t = 0; t < threads; ++t) {
                workers.emplace_back([&] {
                  const Status done = (*projection)->work(stop, pixels);
                  EXPECT_TRUE(done);
                });
              }
            }
            auto result = (*projection)->finish();
            ASSERT_TRUE(result) << result.error().text();
            EXPECT_EQ(pixels, std::int64_t{width} * 80);
            EXPECT_TRUE(result->radiance == first)
                << path << " width " << width << " band " << band_rows << " threads " << threads;
          }
        }
      });
    }
  }
}

TEST_F(Projector, GivesTheSameBitsForEveryWidth) {
  for (const MapFormat format : {MapFormat::exr_half, MapFormat::exr_float, MapFormat::hdr}) {
    for (int width = 1; width <= 67; ++width) {
      const auto path = write(test::make_noisy_picture(width, 20, width), format, "width");
      const ProjectionSettings settings = settings_of(3, Quadrature::texel);
      const Coefficients first = project(path, settings).radiance;
      test::for_every_target([&] {
        ReadOptions options;
        options.rows_per_band = 3;
        EXPECT_TRUE(project(path, settings, options).radiance == first) << path << " " << width;
      });
    }
  }
}

// The order of bands is the scheduler's affair: a table filled band by band in any order holds the
// same.
TEST_F(Projector, DoesNotDependOnTheOrderOfBands) {
  const auto path = write(test::make_noisy_picture(100, 200, 9), MapFormat::exr_half, "order");
  const ProjectionSettings settings = settings_of(6, Quadrature::texel);
  const Coefficients expected = project(path, settings).radiance;
  ReadOptions options;
  options.rows_per_band = 1;
  const auto source = open_panorama(path, options, portable_chunk_codecs());
  ASSERT_TRUE(source) << source.error().text();
  const PictureInfo& info = (*source)->info();
  ASSERT_EQ(info.band_access, BandAccess::random);
  ProjectionTables tables;
  const auto grid = tables.get({info.width, info.height, Sampling::centers}, Quadrature::texel, 6);
  test::RandomNumbers random(1);
  for (int shuffle = 0; shuffle < 5; ++shuffle) {
    std::vector<int> order(info.band_count);
    for (int i = 0; i < info.band_count; ++i) order[i] = i;
    for (int i = info.band_count - 1; i > 0; --i) std::swap(order[i], order[random.below(i + 1)]);
    auto reader = (*source)->new_reader();
    ASSERT_TRUE(reader);
    MomentTable table(3, 6, info.height);
    kernels::RowMomentScratch scratch;
    for (const int index : order) {
      const auto band = (*reader)->read(index);
      ASSERT_TRUE(band) << band.error().text();
      std::vector<kernels::SampleRange> ranges(3 * band->row_count());
      kernels::row_moments(
          grid->moments, *band, scratch,
          {table.column(0, 0) + band->row_begin,
           static_cast<std::ptrdiff_t>(table.moment_count) * table.row_count, table.row_count},
          ranges);
    }
    EXPECT_TRUE(contract(table, grid->weights) == expected);
  }
}

TEST_F(Projector, ReportsWhatItMet) {
  Picture picture = test::make_picture(
      64, 32, [](int c, int i, int j) { return 1.0 + c + (i == 3 && j == 5 ? 10.0 : 0.0); });
  picture.at(1, 20, 63) = -2.0F;
  const Projection result =
      project(write(picture, MapFormat::exr_float, "report"), settings_of(0, Quadrature::texel));
  EXPECT_EQ(result.pixels.pixel_count, 64 * 32);
  EXPECT_EQ(result.pixels.negative_count, 1);
  EXPECT_EQ(result.pixels.nonfinite_count, 0);
  EXPECT_EQ(result.pixels.clamped_count, 0);
  EXPECT_EQ(result.pixels.minimum, (std::array<double, 3>{1.0, -2.0, 3.0}));
  EXPECT_EQ(result.pixels.maximum, (std::array<double, 3>{11.0, 12.0, 13.0}));
  EXPECT_NEAR(result.pixels.mean[0], 1.0 + 10.0 / (64 * 32), 1e-7);
  EXPECT_NEAR(result.pixels.mean[1], 2.0 + (10.0 - 4.0) / (64 * 32), 1e-7);
  EXPECT_NEAR(result.solid_angle, 4.0 * kPi, 1e-13);
}

TEST_F(Projector, RefusesNonFinitePixelsAndSaysWhereTheFirstIs) {
  Picture picture = test::make_picture(64, 64, [](int, int, int) { return 1.0; });
  picture.at(0, 40, 7) = NAN;
  picture.at(2, 40, 7) = INFINITY;
  picture.at(1, 12, 63) = -INFINITY;
  const auto path = write(picture, MapFormat::exr_float, "nan");
  ProjectionTables tables;
  ProjectionSettings settings;
  const auto refused = project_panorama(path, {}, settings, tables);
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().text(),
            path.string() +
                ":12: 2 pixels are not finite (NaN or infinity), the first in row 12, column 63 "
                "(nonfinite: zero takes them as black)");
  settings.pixels.nonfinite = PixelPolicy::NonFinite::zero;
  const Projection zeroed = project(path, settings);
  EXPECT_EQ(zeroed.pixels.nonfinite_count, 2);
  EXPECT_EQ(zeroed.pixels.maximum[0], 1.0);
  // Only the channels that are not finite become black.
  EXPECT_NEAR(zeroed.pixels.mean[0], 1.0 - 1.0 / 4096, 1e-7);
  EXPECT_NEAR(zeroed.pixels.mean[1], 1.0 - 1.0 / 4096, 1e-7);
}

TEST_F(Projector, ZeroesNegativesOnRequest) {
  const Picture picture = test::make_picture(
      64, 32, [](int c, int i, int) { return c == 0 && i % 2 == 0 ? -1.0 : 1.0; });
  const auto path = write(picture, MapFormat::exr_half, "negative");
  ProjectionSettings settings;
  EXPECT_NEAR(project(path, settings).pixels.mean[0], 0.0, 1e-7);
  settings.pixels.negative = PixelPolicy::Negative::zero;
  const Projection zeroed = project(path, settings);
  EXPECT_NEAR(zeroed.pixels.mean[0], 0.5, 1e-7);
  EXPECT_EQ(zeroed.pixels.negative_count, 64 * 16);
  EXPECT_EQ(zeroed.pixels.minimum[0], -1.0);
}

// What the clamp takes from a pixel of solid angle w is w (I - clamp); before and after differ by
// just that.
TEST_F(Projector, AccountsForTheLightThatTheClampTakes) {
  const auto path = write(test::make_noisy_picture(100, 50, 3), MapFormat::exr_float, "clamp");
  ProjectionSettings settings;
  const Projection before = project(path, settings);
  settings.pixels.clamp = 10.0;
  const Projection after = project(path, settings);
  EXPECT_GT(after.pixels.clamped_count, 0);
  for (int c = 0; c < 3; ++c) {
    const double flux =
        std::sqrt(4.0 * kPi) * (before.radiance.channels[c][0] - after.radiance.channels[c][0]);
    EXPECT_NEAR(after.pixels.clamped_flux[c], flux, 1e-6 * flux);
  }
}

// Values whose plain sums would leave the range of a float.
TEST_F(Projector, TakesTheLargestFloats) {
  const auto path = write(test::make_picture(64, 32, [](int, int, int) { return 3e38; }),
                          MapFormat::exr_float, "huge");
  const Projection result = project(path, settings_of(0, Quadrature::texel));
  EXPECT_NEAR(result.radiance.channels[0][0] / (std::sqrt(4.0 * kPi) * 3e38), 1.0, 1e-6);
}

// The same beside a sample that is not finite, in any channel.
TEST_F(Projector, TakesTheLargestFloatsBesideWhatIsNotFinite) {
  Picture picture = test::make_picture(64, 32, [](int c, int, int) { return c == 1 ? 3e38 : 1.0; });
  picture.at(1, 7, 9) = NAN;
  ProjectionSettings settings = settings_of(0, Quadrature::texel);
  settings.pixels.nonfinite = PixelPolicy::NonFinite::zero;
  const Projection result = project(write(picture, MapFormat::exr_float, "huge"), settings);
  // One pixel of 2048 is black.
  EXPECT_NEAR(result.radiance.channels[1][0] / (std::sqrt(4.0 * kPi) * 3e38), 1.0, 1e-3);
}

TEST_F(Projector, StopsWhenAsked) {
  const auto path = write(test::make_noisy_picture(64, 32, 1), MapFormat::hdr, "stop");
  ProjectionTables tables;
  auto projection = PanoramaProjection::open(path, {}, {}, tables);
  ASSERT_TRUE(projection);
  const std::atomic<bool> stop{true};
  std::atomic<std::int64_t> pixels{0};
  const Status stopped = (*projection)->work(stop, pixels);
  ASSERT_FALSE(stopped);
  EXPECT_EQ(stopped.error().code, ErrorCode::interrupted);
}

}  // namespace
}  // namespace shoal
