#include "transform/bright_texels.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <random>
#include <thread>
#include <tuple>

#include "bright_light_fixture.h"
#include "sphere/texel_geometry.h"
#include "support/every_target.h"
#include "support/made_picture.h"

namespace shoal::test {
namespace {

// The definition: all texels in their order, to the first with which the fraction is covered.
std::vector<BrightTexel> by_brute_force(std::vector<BrightTexel> texels, double fraction,
                                        float floor, const BrightTexels::SolidAngle& solid_angle) {
  std::erase_if(texels, [floor](const BrightTexel& texel) { return !(texel.value() > floor); });
  std::ranges::sort(texels, std::less(), [](const BrightTexel& texel) {
    return std::tuple(-texel.value(), texel.row, texel.column);
  });
  double covered = 0.0;
  for (std::size_t i = 0; i < texels.size(); ++i) {
    covered += solid_angle(texels[i].row, texels[i].column);
    if (covered > fraction * 4.0 * kPi) texels.resize(i + 1);
  }
  return texels;
}

// 200 x 100 texels of few values, so that many are equally bright: which are kept must be decided
// by their places, and not by who brings them when.
TEST(BrightTexels, KeepsTheSameInEveryOrderAndFromManyWorkers) {
  constexpr int kWidth = 200, kHeight = 100;
  const auto solid_angle = [](int row, int) {
    return 2.0 * kPi / kWidth * 2.0 * std::sin(kPi * (row + 0.5) / kHeight) *
           std::sin(kPi / (2 * kHeight));
  };
  RandomNumbers random(7);
  std::vector<BrightTexel> all;
  for (int i = 0; i < kHeight; ++i) {
    for (int j = 0; j < kWidth; ++j) {
      const auto value = [&random] {
        return static_cast<float>(std::floor(random.between(-3, 9)));
      };
      all.push_back({i, j, {value(), value(), value()}});
    }
  }
  std::mt19937 shuffle(1);
  for (const float floor : {0.0F, 7.0F, 8.0F}) {
    const auto expected = by_brute_force(all, 0.01, floor, solid_angle);
    for (int round = 0; round < 6; ++round) {
      BrightTexels bright(0.01, floor, solid_angle);
      std::vector<std::jthread> workers;
      for (int worker = 0; worker < 4; ++worker) {
        workers.emplace_back([&, worker] {
          for (std::size_t begin = worker * 50; begin < all.size(); begin += 200) {
            bright.add(std::span(all).subspan(begin, 50));
          }
        });
      }
      workers.clear();
      EXPECT_TRUE(bright.brightest().texels == expected) << "floor " << floor;
      std::ranges::shuffle(all, shuffle);
    }
  }
}

// Of n equal texels brighter than the rest, covering a part p of the sphere: the value above which
// at most f lies is theirs where p > f, and that of the rest where p <= f.
TEST(BrightTexels, TheThresholdIsTheFirstValueThatIsNotWithinTheFraction) {
  const auto solid_angle = [](int, int) { return 4.0 * kPi / 1000.0; };
  BrightTexels bright(0.01, 0.0F, solid_angle);
  std::vector<BrightTexel> texels;
  for (int j = 0; j < 1000; ++j) texels.push_back({0, j, {j < 5 ? 9.0F : 2.0F, 1.0F, 1.0F}});
  bright.add(texels);
  const BrightestTexels brightest = bright.brightest();
  EXPECT_EQ(brightest.threshold(0.0045), 9.0F);
  EXPECT_EQ(brightest.threshold(0.0055), 2.0F);
  BrightTexels few(0.01, 5.0F, solid_angle);
  few.add(texels);
  EXPECT_EQ(few.brightest().threshold(0.01), 0.0F);
}

TEST_F(BrightLight, TheSameBitsForEveryTargetThreadCountAndBandHeight) {
  // RGBE has few mantissas, so that its texels tie.
  for (const MapFormat format : {MapFormat::exr_float, MapFormat::hdr}) {
    const auto path = write(make_noisy_picture(256, 128, 5), "same", format);
    ProjectionSettings settings = clamp_at(99.5, 4);
    settings.sun = {0.002, 0.0, SunSettings::Action::replace};
    const Projection first = project(path, settings);
    EXPECT_GT(first.pixels.clamped_count, 50);
    for_every_target([&] {
      for (const int rows : {0, 1, 7, 100}) {
        ReadOptions options;
        options.rows_per_band = rows;
        for (const int threads : {1, 3}) {
          EXPECT_TRUE(same(project(path, settings, options, threads), first))
              << path << " rows " << rows << " threads " << threads;
        }
      }
    });
  }
}

// The clamp takes off afterwards, in double, what a clamp to the same value takes during the pass.
// The kernels have rounded what is taken by 8e-7 of the sum of |sample trig| before
// (row_moments.h), and what stays in either case: 1e-6 of the integral of |I Y_lm|, twice. Y_lm <=
// sqrt((2l+1)/4pi).
TEST_F(BrightLight, APercentileClampsAsItsValueDoes) {
  const auto path = write(make_noisy_picture(200, 100, 3), "clamp");
  ProjectionSettings settings = clamp_at(99.2, 6);
  for (const Arithmetic arithmetic : {Arithmetic::kernels, Arithmetic::reference}) {
    settings.arithmetic = arithmetic;
    settings.pixels.clamp_percentile = 0.0;
    settings.pixels.clamp = 0.0;
    const Projection whole = project(path, settings);
    settings.pixels.clamp_percentile = 99.2;
    const Projection late = project(path, settings);
    settings.pixels.clamp_percentile = 0.0;
    settings.pixels.clamp = late.pixels.clamp_threshold;
    const Projection early = project(path, settings);
    const double light = std::sqrt(4.0 * kPi) * whole.radiance.channels[0][0];
    const double bound = arithmetic == Arithmetic::kernels ? 2e-6 : 1e-14;
    EXPECT_LT(difference(late.radiance, early.radiance), bound * light * std::sqrt(13 / (4 * kPi)));
    EXPECT_GT(difference(late.radiance, whole.radiance), 1e-3 * light) << "it does something";
    EXPECT_EQ(late.pixels.clamped_count, early.pixels.clamped_count);
    EXPECT_EQ(late.pixels.clamp_threshold, early.pixels.clamp_threshold);
    EXPECT_NEAR(late.pixels.clamp_colour_shift, early.pixels.clamp_colour_shift, 1e-5);
    for (int c = 0; c < 3; ++c) {
      EXPECT_NEAR(late.pixels.clamped_flux[c], early.pixels.clamped_flux[c],
                  1e-12 * early.pixels.clamped_flux[c]);
      EXPECT_NEAR(late.pixels.mean[c], early.pixels.mean[c], 2e-6 * whole.pixels.mean[c]);
    }
  }
}

// A glow exp(k cos(angle to d)) is above its value at the angle a in the solid angle
// 2 pi (1 - cos a): so the value above which 0.5 % of the sphere lie is exp(k (1 - 0.01)), whatever
// the size. On texels of angle h the region is told to a texel's width: the value within
// k sin(a) h of it.
TEST_F(BrightLight, ThePercentileDoesNotDependOnTheSize) {
  constexpr double k = 20.0;
  const glm::dvec3 towards = glm::normalize(glm::dvec3(0.3, -0.5, 0.7));
  for (const int height : {64, 128, 512}) {
    const Picture picture = make_picture(2 * height, height, [&](int c, int i, int j) {
      const double theta = kPi * (i + 0.5) / height, phi = kPi * (j + 0.5) / height;
      const glm::dvec3 w(std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi),
                         std::cos(theta));
      return (c == 1 ? 1.0 : 0.5) * std::exp(k * glm::dot(w, towards));
    });
    const Projection result = project(write(picture, "glow"), clamp_at(99.5));
    const double expected = k * 0.99;
    EXPECT_NEAR(std::log(result.pixels.clamp_threshold), expected,
                k * std::sin(std::acos(0.99)) * kPi / height)
        << height;
    EXPECT_THAT(result.warnings,
                testing::ElementsAre(testing::HasSubstr("pixels were clamped to")));
  }
}

// Only red is clamped. Red, green and blue of the mean are (1 - r, 1, 1): its distance from white,
// by the definition of (u', v').
TEST_F(BrightLight, TellsHowFarTheColourMoved) {
  const Picture picture = make_picture(
      200, 100, [](int c, int i, int j) { return c == 0 && i == 50 && j < 20 ? 501.0 : 1.0; });
  const Projection result = project(write(picture, "red"), clamp_at(99.0));
  EXPECT_EQ(result.pixels.clamp_threshold, 1.0);
  EXPECT_EQ(result.pixels.clamped_count, 20);
  const double taken = result.pixels.clamped_flux[0] / (4.0 * kPi);
  const auto uv = [](double r) {
    const double x = 0.4124 * r + 0.3576 + 0.1805, y = 0.2126 * r + 0.7152 + 0.0722,
                 z = 0.0193 * r + 0.1192 + 0.9505, sum = x + 15 * y + 3 * z;
    return std::pair(4 * x / sum, 9 * y / sum);
  };
  const auto [u, v] = uv(1.0);
  const auto [moved_u, moved_v] = uv(1.0 + taken);
  // The matrix above has four digits.
  EXPECT_NEAR(result.pixels.clamp_colour_shift, std::hypot(u - moved_u, v - moved_v), 1e-4);
  EXPECT_GT(result.pixels.clamp_colour_shift, 0.01);
}

TEST_F(BrightLight, ClampsInOtherLayoutsToo) {
  const auto geometry = TexelGeometry::create(Layout::octahedral, 64, 64);
  ASSERT_TRUE(geometry);
  const auto path = write(make_noisy_picture(64, 64, 8), "octahedral");
  for (const Arithmetic arithmetic : {Arithmetic::kernels, Arithmetic::reference}) {
    ProjectionSettings settings = clamp_at(99.0, 4);
    settings.layout = Layout::octahedral;
    settings.arithmetic = arithmetic;
    const Projection late = project(path, settings);
    settings.pixels = {};
    const Projection whole = project(path, settings);
    settings.pixels.clamp = late.pixels.clamp_threshold;
    const Projection early = project(path, settings);
    const double light = std::sqrt(4.0 * kPi) * whole.radiance.channels[0][0];
    EXPECT_LT(difference(late.radiance, early.radiance),
              (arithmetic == Arithmetic::kernels ? 2e-6 : 1e-14) * light);
    EXPECT_EQ(late.pixels.clamped_count, early.pixels.clamped_count);
    EXPECT_GT(late.pixels.clamped_count, 20);
    settings.pixels = clamp_at(99.0).pixels;
    EXPECT_TRUE(same(project(path, settings, {}, 3), late));
  }
}

// One scene of 6 x 4 texels in the orders in which Radiance files may hold it.
TEST_F(BrightLight, ClampsWhicheverWayTheFileRuns) {
  const auto texel = [](int row, int column) {
    const int hash = (row * 6 + column) * 37 % 24;
    return std::string{static_cast<char>(128 + hash), static_cast<char>(200 - hash),
                       static_cast<char>(140), static_cast<char>(128 + (hash > 21 ? 9 : 0))};
  };
  const auto write_file = [&](const std::string& name, const std::string& order, bool columns,
                              bool mirrored) {
    std::string bytes = "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n" + order + "\n";
    const int lines = columns ? 6 : 4, samples = columns ? 4 : 6;
    for (int line = 0; line < lines; ++line) {
      for (int k = 0; k < samples; ++k) {
        const int sample = mirrored ? samples - 1 - k : k;
        bytes += columns ? texel(sample, line) : texel(line, sample);
      }
    }
    std::ofstream(folder_ / name, std::ios::binary) << bytes;
    return folder_ / name;
  };
  ProjectionSettings settings = clamp_at(99.0, 3);
  // 24 texels: the brightest one covers more than 1 %, so that it is not above the threshold. The
  // sun is: every texel above 2.
  settings.sun = {0.0, 2.0, SunSettings::Action::remove};
  const Projection plain = project(write_file("a.hdr", "-Y 4 +X 6", false, false), settings);
  EXPECT_GT(plain.warnings.size(), 0U);
  for (const auto& [name, order, columns, mirrored] :
       {std::tuple("b.hdr", "-Y 4 -X 6", false, true),
        std::tuple("c.hdr", "+X 6 -Y 4", true, false),
        std::tuple("d.hdr", "+X 6 +Y 4", true, true)}) {
    const Projection turned = project(write_file(name, order, columns, mirrored), settings);
    EXPECT_LT(difference(turned.radiance, plain.radiance), 1e-6 * plain.radiance.channels[0][0])
        << order;
    EXPECT_EQ(turned.warnings, plain.warnings) << order;
  }
}

}  // namespace
}  // namespace shoal::test
