#include "scenes/difference.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "scenes/colours.h"

namespace shoal::viz {
namespace {

constexpr double kPi = std::numbers::pi;

Pixels grey(int width, int height, float value) {
  return {width, height, std::vector<float>(std::size_t{3} * width * height, value)};
}

float* texel(Pixels& pixels, int row, int column) {
  return pixels.rgb.data() + 3 * (row * pixels.width + column);
}

TEST(Difference, OfAPictureWithItselfIsNothing) {
  const Pixels pixels = grey(16, 8, 2.0f);
  const Difference difference = difference_of(pixels, pixels, Channel::luminance);
  EXPECT_EQ(difference.rms, 0.0);
  EXPECT_EQ(difference.relative_rms, 0.0);
  EXPECT_EQ(difference.largest, 0.0);
  EXPECT_EQ(difference.scale, 1.0);
  EXPECT_EQ(difference.beyond, 0.0);
  EXPECT_EQ(difference.values, std::vector<double>(16 * 8, 0.0));
}

// 3 minus 1 everywhere; the sum of the luminance's weights is 1 up to rounding.
TEST(Difference, OfConstantsIsTheirs) {
  const Difference difference =
      difference_of(grey(16, 8, 1.0f), grey(16, 8, 3.0f), Channel::luminance);
  EXPECT_NEAR(difference.rms, 2.0, 1e-14);
  EXPECT_NEAR(difference.relative_rms, 2.0, 1e-14);
  EXPECT_NEAR(difference.largest, 2.0, 1e-14);
  EXPECT_NEAR(difference.scale, 2.0, 1e-14);
}

// One texel darker by 5: its square counts with its share of the sphere, and the colours' scale is
// that of all the others, three of 800 being below half a percent.
TEST(Difference, OfASpotCountsWithItsSolidAngle) {
  const Pixels left = grey(40, 20, 1.0f);
  Pixels right = grey(40, 20, 1.25f);
  std::fill_n(texel(right, 3, 7), 3, -4.0f);
  const Difference difference = difference_of(left, right, Channel::green);
  const double share = (std::cos(kPi * 3 / 20) - std::cos(kPi * 4 / 20)) / (2.0 * 40);
  EXPECT_NEAR(difference.rms, std::sqrt(25.0 * share + 0.0625 * (1.0 - share)), 1e-14);
  EXPECT_EQ(difference.largest, 5.0);
  EXPECT_EQ(difference.largest_texel, 3u * 40 + 7);
  EXPECT_EQ(difference.values[3 * 40 + 7], -5.0);
  EXPECT_EQ(difference.scale, 0.25);
  EXPECT_EQ(difference.beyond, 1.0 / 800.0);  // the spot alone
}

TEST(Difference, IsThatOfTheChannel) {
  const Pixels left = grey(8, 4, 1.0f);
  Pixels right = left;
  texel(right, 1, 1)[2] = 3.0f;
  EXPECT_EQ(difference_of(left, right, Channel::red).largest, 0.0);
  EXPECT_EQ(difference_of(left, right, Channel::blue).largest, 2.0);
  EXPECT_NEAR(difference_of(left, right, Channel::luminance).largest, 2.0 * 0.0722, 1e-15);
}

// More light at the right is orange, less is blue, and what is beyond the scale has its end's
// colour.
TEST(Difference, IsDrawnInTheColoursOfItsSign) {
  const Pixels left = grey(2, 1, 1.0f);
  Pixels right = left;
  std::fill_n(texel(right, 0, 0), 3, 2.0f);
  std::fill_n(texel(right, 0, 1), 3, 0.0f);
  const Picture picture = difference_picture(difference_of(left, right, Channel::red), left);
  ASSERT_EQ(picture.size, (PictureSize{2, 1}));
  for (int c = 0; c < 3; ++c) {
    EXPECT_EQ(picture.rgb[c], std::lround(255.0f * diverging_colour(1.0)[c]));
    EXPECT_EQ(picture.rgb[3 + c], std::lround(255.0f * diverging_colour(-1.0)[c]));
  }
}

}  // namespace
}  // namespace shoal::viz
