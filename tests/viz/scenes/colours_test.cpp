#include "scenes/colours.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace shoal::viz {
namespace {

constexpr int kSteps = 1000;

TEST(SequentialColours, GrowStrictlyInLightness) {
  double before = -1.0;
  for (int i = 0; i <= kSteps; ++i) {
    const double now = lightness(sequential_colour(double(i) / kSteps));
    EXPECT_GT(now, before) << i;
    before = now;
  }
  EXPECT_LT(lightness(sequential_colour(0.0)), 0.2);
  EXPECT_GT(lightness(sequential_colour(1.0)), 0.9);
}

TEST(DivergingColours, FallInLightnessToBothEndsAlike) {
  double before = 2.0;
  for (int i = 0; i <= kSteps / 2; ++i) {
    const double t = 2.0 * i / kSteps;
    const double positive = lightness(diverging_colour(t));
    EXPECT_LT(positive, before) << t;
    // Colours that sRGB cannot show are clamped to it, which costs little lightness.
    EXPECT_NEAR(lightness(diverging_colour(-t)), positive, 0.01) << t;
    before = positive;
  }
}

// The middle has no hue; at the ends blue and orange differ in blue and red even to eyes that lack
// one of the longer cones.
TEST(DivergingColours, AreNeutralInTheMiddleAndOppositeAtTheEnds) {
  const glm::vec3 middle = diverging_colour(0.0);
  EXPECT_NEAR(middle.r, middle.g, 0.02);
  EXPECT_NEAR(middle.g, middle.b, 0.02);
  const glm::vec3 blue = diverging_colour(-1.0);
  const glm::vec3 orange = diverging_colour(1.0);
  EXPECT_GT(blue.b - orange.b, 0.4f);
  EXPECT_GT(orange.r - blue.r, 0.4f);
}

TEST(Colours, ClampWhatIsOutside) {
  EXPECT_EQ(diverging_colour(-7.0), diverging_colour(-1.0));
  EXPECT_EQ(sequential_colour(7.0), sequential_colour(1.0));
  EXPECT_EQ(sequential_colour(std::numeric_limits<double>::quiet_NaN()), glm::vec3(0.0f));
}

TEST(ToneMapping, IsTheSrgbCurveBelowTheKneeAndNeverReachesWhite) {
  // 0.5 linear is 0.7354 in sRGB (IEC 61966-2-1).
  EXPECT_NEAR(tone_mapped({0.25, 0.25, 0.25}, 2.0).g, 0.7354, 1e-4);
  float before = -1.0f;
  for (double x = 0.0; x < 3.0; x += 0.01) {
    const float now = tone_mapped({x, x, x}, 1.0).r;
    EXPECT_GT(now, before) << x;
    EXPECT_LT(now, 1.0f) << x;
    before = now;
  }
}

TEST(ToneMapping, ShowsWhatIsNoLight) {
  EXPECT_EQ(tone_mapped({-1.0, -2.0, -0.1}, 1.0), glm::vec3(0.0f));
  const double infinity = std::numeric_limits<double>::infinity();
  EXPECT_EQ(tone_mapped({0.1, infinity, 0.1}, 1.0), glm::vec3(1.0f, 0.0f, 1.0f));
}

TEST(PureColour, KeepsTheRatiosOfLight) {
  EXPECT_EQ(pure_colour({8.0, 8.0, 8.0}), glm::vec3(1.0f));
  EXPECT_EQ(pure_colour({0.0, 100.0, -3.0}), glm::vec3(0.0f, 1.0f, 0.0f));
  EXPECT_EQ(pure_colour({0.1, 0.2, 0.05}), pure_colour({10.0, 20.0, 5.0}));
}

// Black on white is 1, the other way round 0.
TEST(Lightness, IsThatOfGrey) {
  EXPECT_NEAR(lightness({1.0f, 1.0f, 1.0f}), 1.0, 1e-6);
  EXPECT_NEAR(lightness({0.0f, 0.0f, 0.0f}), 0.0, 1e-12);
}

}  // namespace
}  // namespace shoal::viz
