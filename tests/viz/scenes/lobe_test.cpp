#include "scenes/lobe.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

#include "scenes/colours.h"
#include "viz/scenes/made_library.h"

namespace shoal::viz {
namespace {

// A point of the picture, by the fractions of its width and height: sphere/conventions.h.
glm::dvec3 native_direction(double across, double down) {
  const double theta = std::numbers::pi * down;
  const double phi = 2.0 * std::numbers::pi * across;
  return {std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi), std::cos(theta)};
}

// A band-limited delta function is largest, by far, where the light is: its value there is
// sum over l of (2l+1)/(4 pi), and Legendre polynomials are less than 1 everywhere else. So the
// farthest vertex must lie where the frame's definition puts that point of the picture.
TEST(Lobe, PointsInEveryFrameWhereTheLightIs) {
  for (const FrameAlias& alias : frame_aliases()) {
    const struct {
      double across, down;
      SignedAxis axis;
    } places[] = {{0.5, 0.5, alias.frame.center},
                  {0.75, 0.5, alias.frame.right},
                  {0.5, 0.0, alias.frame.up},
                  {0.5, 1.0, {alias.frame.up.axis, -alias.frame.up.sign}}};
    for (const auto& place : places) {
      const Panorama panorama = test::panorama_of(
          "light",
          test::light_from(native_direction(place.across, place.down), {1.0, 1.0, 1.0}, 4));
      SceneSettings settings;
      settings.frame = alias.frame;
      const Lobe lobe = make_lobe(panorama, settings, 16);
      const glm::vec3 expected(direction_of(place.axis));
      EXPECT_EQ(lobe.largest_direction, std::optional(expected)) << alias.name;
      const auto farthest = std::max_element(
          lobe.mesh.positions.begin(), lobe.mesh.positions.end(),
          [](const glm::vec3& a, const glm::vec3& b) { return glm::length(a) < glm::length(b); });
      EXPECT_NEAR(glm::distance(*farthest, expected), 0.0, 1e-6) << alias.name;
    }
  }
}

// A constant is c sqrt(4 pi) Y_00: c wherever one looks, and no direction stands out. Black is one
// of them.
TEST(Lobe, OfAConstantPointsNowhere) {
  for (const double constant : {0.0, 0.3}) {
    Coefficients light = test::light_from({0.0, 0.0, 1.0}, {0.0, 0.0, 0.0}, 3);
    for (int c = 0; c < kChannelCount; ++c) {
      light.channels[c][0] = constant * std::sqrt(4.0 * std::numbers::pi);
    }
    const Lobe lobe = make_lobe(test::panorama_of("light", light), {}, 16);
    EXPECT_NEAR(lobe.largest, constant, 1e-15);
    EXPECT_FALSE(lobe.largest_direction.has_value());
  }
}

// Irradiance of a light of unit power from above, degree 2: E = 1/4 + cos/2 + 5/16 (3 cos^2 - 1)/2.
// At the zenith 1/4 + 1/2 + 5/16 = 17/16. Its derivative 1/2 + 15/16 x vanishes at x = -8/15: the
// least value is 1/4 - 4/15 + 5/32 (3 (64/225) - 1).
TEST(Lobe, HasTheExtremaOfAPolynomial) {
  const Panorama panorama =
      test::panorama_of("light", test::light_from({0.0, 0.0, 1.0}, {1.0, 1.0, 1.0}, 2));
  SceneSettings settings;
  settings.quantity = Quantity::irradiance;
  const Lobe lobe = make_lobe(panorama, settings, kFineRings);
  const double x = -8.0 / 15.0;
  const double least = 0.25 + 0.5 * x + 5.0 / 32.0 * (3.0 * x * x - 1.0);
  EXPECT_NEAR(lobe.largest, 17.0 / 16.0, 1e-12);
  // A vertex is within a quarter of a degree of ring distance; second order in that.
  EXPECT_NEAR(lobe.smallest, least, 15.0 / 32.0 * std::pow(0.5 * std::numbers::pi / kFineRings, 2));
  EXPECT_NEAR(lobe.mean, 0.25, 1e-14);
  EXPECT_EQ(lobe.unit, lobe.largest);
  EXPECT_EQ(lobe.degree, 2);
}

TEST(Lobe, ShowsTheChannelAndDegreeThatIsAskedFor) {
  const Panorama panorama =
      test::panorama_of("light", test::light_from({1.0, 0.0, 0.0}, {1.0, 2.0, 4.0}, 6));
  SceneSettings settings;
  settings.channel = Channel::red;
  settings.degree = 3;
  const Lobe red = make_lobe(panorama, settings, 8);
  settings.channel = Channel::blue;
  const Lobe blue = make_lobe(panorama, settings, 8);
  // sum of (2l+1)/(4 pi), l <= 3
  EXPECT_NEAR(red.largest, 16.0 / (4.0 * std::numbers::pi), 1e-12);
  EXPECT_NEAR(blue.largest, 4.0 * red.largest, 1e-12);
  EXPECT_EQ(red.degree, 3);
}

TEST(Lobe, OfDarknessIsAPoint) {
  const Lobe lobe = make_lobe(test::panorama_of("dark", Coefficients(2)), {}, 4);
  EXPECT_EQ(lobe.unit, 1.0);
  for (const glm::vec3& p : lobe.mesh.positions) EXPECT_EQ(p, glm::vec3(0.0f));
}

TEST(Lobe, ColoursBySignOrByLight) {
  const Panorama panorama =
      test::panorama_of("light", test::light_from({0.0, 0.0, 1.0}, {1.0, 0.5, 0.25}, 4));
  SceneSettings settings;
  const Lobe sign = make_lobe(panorama, settings, 8);
  settings.colour = LobeColour::light;
  const Lobe light = make_lobe(panorama, settings, 8);
  for (std::size_t i = 0; i < sign.colours.size(); ++i) {
    EXPECT_EQ(sign.colours[i], sign.mesh.values[i] < 0.0f ? theme::kNegative : theme::kPositive);
    if (sign.mesh.values[i] > 1e-6f) {
      EXPECT_NEAR(glm::distance(light.colours[i], pure_colour({1.0, 0.5, 0.25})), 0.0f, 1e-5f);
    }
  }
}

}  // namespace
}  // namespace shoal::viz
