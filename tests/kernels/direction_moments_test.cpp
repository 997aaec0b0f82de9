#include "kernels/direction_moments.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "sphere/basis.h"
#include "support/every_target.h"
#include "support/made_band.h"
#include "support/random_numbers.h"

namespace shoal::kernels {
namespace {

using test::MadeBand;

// Texels that look anywhere, the poles and the axes among them.
struct Directions {
  std::vector<float> x, y, z, solid_angle;

  explicit Directions(int count, std::uint64_t seed) {
    test::RandomNumbers random(seed);
    for (int i = 0; i < count; ++i) {
      const double cos_theta = i % 7 == 0 ? (i % 2 == 0 ? 1.0 : -1.0) : random.between(-1.0, 1.0);
      const double phi = random.between(0.0, 2.0 * std::numbers::pi);
      const double sin_theta = std::sqrt(1.0 - cos_theta * cos_theta);
      x.push_back(static_cast<float>(sin_theta * std::cos(phi)));
      y.push_back(static_cast<float>(sin_theta * std::sin(phi)));
      z.push_back(static_cast<float>(cos_theta));
      solid_angle.push_back(static_cast<float>(random.between(0.0, 1e-3)));
    }
  }
  [[nodiscard]] TexelDirections view() const {
    return {x.data(), y.data(), z.data(), solid_angle.data()};
  }
};

struct Sums {
  std::vector<double> values;  // (channels, (L+1)^2)
  std::vector<SampleRange> ranges;
};

Sums sums_of(const MadeBand& made, int row, int degree, const Directions& directions) {
  const DirectionPlan plan = make_direction_plan(degree);
  DirectionScratch scratch;
  Sums sums;
  const auto channels = static_cast<std::size_t>(made.band.channel_count);
  // Whatever was there before is overwritten.
  sums.values.assign(channels * plan.coefficient_count(), 1e30);
  sums.ranges.resize(channels);
  direction_moments(plan, made.band, row, directions.view(), scratch, sums.values, sums.ranges);
  return sums;
}

// The defining sums in long double, the directions as the floats they are, made unit length: that
// moves them by at most 2u, which the bound's (l + 8) has room for.
void expect_defining_sums(const MadeBand& made, int degree) {
  const Directions directions(made.band.width, 7);
  const Basis<long double> basis(degree);
  const int count = (degree + 1) * (degree + 1);
  std::vector<long double> values(count);
  for (int row = 0; row < made.band.row_count(); ++row) {
    const Sums sums = sums_of(made, row, degree, directions);
    for (int c = 0; c < made.band.channel_count; ++c) {
      std::vector<long double> exact(count, 0.0L);
      long double light = 0.0L;
      for (int j = 0; j < made.band.width; ++j) {
        const glm::vec<3, long double> at(directions.x[j], directions.y[j], directions.z[j]);
        basis.evaluate(at / std::sqrt(dot(at, at)), values);
        const long double weighted =
            static_cast<long double>(made.value(c, row, j)) * directions.solid_angle[j];
        light += std::abs(weighted);
        for (int i = 0; i < count; ++i) exact[i] += weighted * values[i];
      }
      for (int i = 0; i < count; ++i) {
        const int l = static_cast<int>(std::sqrt(i));
        const long double largest = std::sqrt((2 * l + 1) / (2 * std::numbers::pi_v<long double>));
        const long double bound = 2 * (l + 8) * 0x1p-24L * largest * light;  // the header's
        EXPECT_LE(std::abs(sums.values[c * count + i] - exact[i]), bound)
            << "width " << made.band.width << " channel " << c << " coefficient " << i;
      }
    }
  }
}

TEST(DirectionMoments, AreTheDefiningSumsForEveryWidthAndSampleType) {
  for (const SampleType type : test::kAllSampleTypes) {
    for (const int width : {1, 7, 15, 16, 17, 33, 128, 511, 512, 513, 1100}) {
      expect_defining_sums(test::make_band(type, width, 2, 3, width), 2);
    }
  }
}

TEST(DirectionMoments, AreTheDefiningSumsForGreyAndHighDegrees) {
  for (const int degree : {0, 1, 3, 10, 31, 64}) {
    expect_defining_sums(test::make_band(SampleType::half, 200, 1, 1, degree), degree);
    expect_defining_sums(test::make_band(SampleType::float32, 530, 1, 3, degree), degree);
  }
}

TEST(DirectionMoments, AreTheSameBitsOnEveryTarget) {
  const Directions directions(1100, 3);
  for (const SampleType type : test::kAllSampleTypes) {
    const MadeBand made = test::make_band(type, 1100, 1, 3, 5);
    const Sums expected = sums_of(made, 0, 12, directions);
    test::for_every_target(
        [&] { EXPECT_EQ(sums_of(made, 0, 12, directions).values, expected.values); });
  }
}

// A texel without solid angle (outside the disc of an angular map, say) adds nothing.
TEST(DirectionMoments, IgnoreTexelsWithoutSolidAngle) {
  Directions directions(600, 11);
  const MadeBand made = test::make_band(SampleType::half, 600, 1, 3, 5);
  for (int j = 0; j < 600; ++j) {
    if (j != 417) directions.solid_angle[j] = 0.0F;
  }
  const Sums sums = sums_of(made, 0, 2, directions);
  for (int c = 0; c < 3; ++c) {
    const double light = made.value(c, 0, 417) * directions.solid_angle[417];
    // Y_00 everywhere is 1/2 sqrt(1/pi); three roundings, of light, constant and product.
    EXPECT_NEAR(sums.values[c * 9], light * 0.5 * std::sqrt(std::numbers::inv_pi),
                4 * 0x1p-24 * light);
  }
}

TEST(DirectionMoments, GiveTheExtremesOfTheRow) {
  const MadeBand made = test::make_band(SampleType::float32, 530, 3, 3, 9);
  const Directions directions(530, 2);
  for (int r = 0; r < 3; ++r) {
    const Sums sums = sums_of(made, r, 0, directions);
    for (int c = 0; c < 3; ++c) {
      const double* first = &made.values[(c * 3 + r) * 530];
      EXPECT_EQ(sums.ranges[c].minimum, *std::min_element(first, first + 530));
      EXPECT_EQ(sums.ranges[c].maximum, *std::max_element(first, first + 530));
    }
  }
}

}  // namespace
}  // namespace shoal::kernels
