#include "kernels/row_moments.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "support/every_target.h"
#include "support/made_band.h"

namespace shoal::kernels {
namespace {

using test::MadeBand;

constexpr long double kPi = std::numbers::pi_v<long double>;

ColumnPhases centers(int width) { return {1, 2, 2L * width, 1.0}; }
ColumnPhases endpoints(int width) { return {0, 1, width - 1L, 0.5}; }

struct Moments {
  int count = 0;
  int rows = 0;
  std::vector<double> values;  // (channels, count, rows)
  std::vector<SampleRange> ranges;

  [[nodiscard]] double at(int channel, int moment, int row) const {
    return values[(static_cast<std::size_t>(channel) * count + moment) * rows + row];
  }
};

Moments moments_of(const RowBand& band, int degree, const ColumnPhases& phases) {
  Moments moments;
  moments.count = 2 * degree + 1;
  moments.rows = band.row_count();
  moments.values.resize(static_cast<std::size_t>(band.channel_count) * moments.count *
                        moments.rows);
  moments.ranges.resize(static_cast<std::size_t>(band.channel_count) * moments.rows);
  RowMomentScratch scratch;
  row_moments(make_row_moment_plan(band.width, degree, phases), band, scratch,
              {moments.values.data(), static_cast<std::ptrdiff_t>(moments.count) * moments.rows,
               moments.rows},
              moments.ranges);
  return moments;
}

// The defining sums in long double. `magnitude` is the same sum over |I trig|, which the promised
// bound is relative to.
struct Exact {
  long double value = 0.0L;
  long double magnitude = 0.0L;
  long double total = 0.0L;  // sum of |I|
};

Exact exact_moment(const MadeBand& made, int channel, int row, int degree, int moment,
                   const ColumnPhases& phases) {
  Exact exact;
  const int width = made.band.width;
  for (int j = 0; j < width; ++j) {
    const int m = moment <= degree ? moment : moment - degree;
    const long double angle =
        2.0L * kPi * m * (phases.first + phases.step * static_cast<long double>(j)) / phases.turn;
    const long double trig = moment <= degree ? std::cos(angle) : std::sin(angle);
    const bool at_edge = j == 0 || j + 1 == width;
    const long double term =
        made.value(channel, row, j) * trig * (at_edge ? phases.edge_weight : 1.0);
    exact.value += term;
    exact.magnitude += std::abs(term);
    exact.total += std::abs(made.value(channel, row, j));
  }
  return exact;
}

void expect_exact_moments(const MadeBand& made, int degree, const ColumnPhases& phases) {
  const Moments moments = moments_of(made.band, degree, phases);
  for (int c = 0; c < made.band.channel_count; ++c) {
    for (int r = 0; r < made.band.row_count(); ++r) {
      for (int k = 0; k < moments.count; ++k) {
        const Exact exact = exact_moment(made, c, r, degree, k, phases);
        const long double bound = 8e-7L * exact.magnitude + 1e-15L * exact.total;  // the header's
        EXPECT_LE(std::abs(moments.at(c, k, r) - exact.value), bound)
            << "width " << made.band.width << " channel " << c << " row " << r << " moment " << k;
      }
    }
  }
}

TEST(RowMoments, AreTheDefiningSumsForEveryWidthAndSampleType) {
  for (const SampleType type : test::kAllSampleTypes) {
    for (int width = 1; width <= 67; ++width) {
      expect_exact_moments(test::make_band(type, width, 2, 3, width), 4, centers(width));
    }
    for (const int width : {68, 100, 126, 128, 130, 1000, 1024, 2052, 5000}) {
      expect_exact_moments(test::make_band(type, width, 2, 3, width), 4, centers(width));
    }
  }
}

TEST(RowMoments, AreTheDefiningSumsForGreyEndpointsAndHighDegrees) {
  expect_exact_moments(test::make_band(SampleType::half, 256, 2, 1, 1), 64, centers(256));
  expect_exact_moments(test::make_band(SampleType::float32, 257, 2, 3, 2), 64, endpoints(257));
  expect_exact_moments(test::make_band(SampleType::half, 512, 1, 1, 3), 10, endpoints(512));
}

// One sample of 10^5 between small ones must not drown them: the bound is relative to what each
// coefficient sums, and carrying to double keeps it for rows of any length.
TEST(RowMoments, KeepTheBoundBesideASun) {
  MadeBand made = test::make_band(SampleType::float32, 8192, 1, 3, 7);
  for (int c = 0; c < 3; ++c) {
    const float sun = 1e5F;
    std::memcpy(const_cast<std::byte*>(made.band.channels[c].data) + 4 * 4000, &sun, sizeof sun);
    made.values[c * 8192 + 4000] = sun;
  }
  expect_exact_moments(made, 8, centers(8192));
}

TEST(RowMoments, AreTheSameBitsOnEveryTarget) {
  std::vector<int> widths;
  for (int width = 1; width <= 67; ++width) widths.push_back(width);
  for (const int width : {1024, 1030, 4096}) widths.push_back(width);
  for (const SampleType type : test::kAllSampleTypes) {
    for (const int width : widths) {
      const MadeBand made = test::make_band(type, width, 3, 3, width);
      const Moments first = moments_of(made.band, 10, centers(width));
      test::for_every_target([&] {
        const Moments here = moments_of(made.band, 10, centers(width));
        EXPECT_TRUE(here.values == first.values) << "width " << width;
      });
    }
  }
}

TEST(RowMoments, GiveTheExtremesOfEveryRow) {
  for (const SampleType type : test::kAllSampleTypes) {
    for (const int width : {1, 5, 64, 67, 200, 1024}) {
      const MadeBand made = test::make_band(type, width, 2, 3, 99);
      const Moments moments = moments_of(made.band, 0, centers(width));
      for (int r = 0; r < 2; ++r) {
        for (int c = 0; c < 3; ++c) {
          double low = made.value(c, r, 0);
          double high = low;
          for (int j = 0; j < width; ++j) {
            low = std::min(low, made.value(c, r, j));
            high = std::max(high, made.value(c, r, j));
          }
          EXPECT_EQ(moments.ranges[r * 3 + c].minimum, low);
          EXPECT_EQ(moments.ranges[r * 3 + c].maximum, high);
          EXPECT_TRUE(moments.ranges[r * 3 + c].finite());
        }
      }
    }
  }
}

TEST(RowMoments, SeeNonFiniteSamplesWhereverTheyStand) {
  for (const int width : {3, 64, 67, 128}) {
    for (int at = 0; at < width; ++at) {
      for (const float bad : {NAN, INFINITY, -INFINITY}) {
        std::vector<float> row(width, 1.0F);
        row[at] = bad;
        const RowBand band{
            0, 1, width, 1, {Plane{std::as_bytes(std::span(row)).data(), 0, SampleType::float32}},
            {}};
        test::for_every_target(
            [&] { EXPECT_FALSE(moments_of(band, 0, centers(width)).ranges[0].finite()) << at; });
      }
    }
  }
}

// Every half and every (mantissa, exponent) pair, against their definitions.
TEST(WidenRow, IsExactForEveryHalf) {
  std::vector<std::uint16_t> bits(0x10000);
  for (std::size_t i = 0; i < bits.size(); ++i) bits[i] = static_cast<std::uint16_t>(i);
  const RowBand band{
      0, 1, 0x10000, 1, {Plane{std::as_bytes(std::span(bits)).data(), 0, SampleType::half}}, {}};
  test::for_every_target([&] {
    std::vector<float> out(bits.size());
    RowMomentScratch scratch;
    widen_row(band, 0, 0, scratch, out.data());
    for (std::size_t i = 0; i < bits.size(); ++i) {
      if ((i >> 10 & 31) == 31) {
        EXPECT_FALSE(std::isfinite(out[i]));
      } else {
        EXPECT_EQ(out[i], test::half_value(bits[i])) << i;
      }
    }
  });
}

TEST(WidenRow, IsExactForEveryRadianceTexel) {
  std::vector<std::uint8_t> mantissas(0x10000);
  std::vector<std::uint8_t> exponents(0x10000);
  for (int i = 0; i < 0x10000; ++i) {
    mantissas[i] = static_cast<std::uint8_t>(i);
    exponents[i] = static_cast<std::uint8_t>(i >> 8);
  }
  for (const SampleType type : {SampleType::rgbe_floor, SampleType::rgbe_center}) {
    RowBand band{0, 1, 0x10000, 1, {Plane{std::as_bytes(std::span(mantissas)).data(), 0, type}},
                 {}};
    band.exponent = {std::as_bytes(std::span(exponents)).data(), 0, type};
    test::for_every_target([&] {
      std::vector<float> out(0x10000);
      RowMomentScratch scratch;
      widen_row(band, 0, 0, scratch, out.data());
      for (int i = 0; i < 0x10000; ++i) {
        EXPECT_EQ(out[i], test::rgbe_value(mantissas[i], exponents[i], type)) << i;
      }
    });
  }
}

// Synthesis is the adjoint of the moments: <moments(x), a> = <x, synthesis(a)> for every x and a.
TEST(SynthesiseRow, IsTheAdjointOfTheMoments) {
  for (const int width : {1, 7, 63, 64, 68, 100, 400, 1024}) {
    const int degree = 10;
    const MadeBand made = test::make_band(SampleType::half, width, 1, 1, width);
    const Moments moments = moments_of(made.band, degree, centers(width));
    test::RandomNumbers random(width);
    std::vector<double> a(2 * degree + 1);
    for (double& value : a) value = random.between(-1.0, 1.0);
    RowMomentScratch scratch;
    std::vector<float> row(width);
    synthesise_row(make_row_moment_plan(width, degree, centers(width)), a, scratch, row.data());
    double left = 0.0;
    double scale = 0.0;
    for (std::size_t k = 0; k < a.size(); ++k) left += moments.at(0, static_cast<int>(k), 0) * a[k];
    double right = 0.0;
    for (int j = 0; j < width; ++j) {
      right += made.value(0, 0, j) * row[j];
      scale += made.value(0, 0, j) * static_cast<double>(a.size());
    }
    // Both sides round in single precision, relative to a sum over |x| |a|.
    EXPECT_NEAR(left, right, 2e-6 * scale) << "width " << width;
  }
}

TEST(SynthesiseRow, IsTheDefiningSumAndTheSameBitsOnEveryTarget) {
  for (const int width : {1, 2, 9, 64, 65, 400, 1028}) {
    const int degree = 16;
    const RowMomentPlan plan = make_row_moment_plan(width, degree, centers(width));
    test::RandomNumbers random(width);
    std::vector<double> a(2 * degree + 1);
    double scale = 0.0;
    for (double& value : a) scale += std::abs(value = random.between(-1.0, 1.0));
    RowMomentScratch scratch;
    std::vector<float> first(width);
    synthesise_row(plan, a, scratch, first.data());
    for (int j = 0; j < width; ++j) {
      long double exact = a[0];
      for (int m = 1; m <= degree; ++m) {
        const long double angle = 2.0L * kPi * m * (j + 0.5L) / width;
        exact += a[m] * std::cos(angle) + a[degree + m] * std::sin(angle);
      }
      // The header's bound: (2L+4) u.
      EXPECT_NEAR(first[j], static_cast<double>(exact), (2 * degree + 4) * 0x1p-24 * scale);
    }
    test::for_every_target([&] {
      std::vector<float> here(width);
      synthesise_row(plan, a, scratch, here.data());
      EXPECT_TRUE(here == first) << "width " << width;
    });
  }
}

}  // namespace
}  // namespace shoal::kernels
