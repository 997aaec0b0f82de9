#include "sphere/light_quality.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

#include "sphere/analytic_lights.h"
#include "sphere/colour_temperature.h"
#include "sphere/degree_window.h"
#include "sphere/linear_operations.h"

namespace shoal {
namespace {

const glm::dvec3 kDirection = glm::normalize(glm::dvec3(-0.6, 0.2, 0.5));

LightQuality quality_of(const std::vector<AnalyticLight>& lights, int degree, int light_degree) {
  return light_quality(project_lights(lights, degree), std::vector<double>(degree + 1, 1.0),
                       project_lights(lights, light_degree));
}

// Of a white directional light of irradiance 1, to degree 2 E = 1/4 + x/2 + 5/32 (3 x^2 - 1), x the
// cosine: greatest 17/16 at x = 1, least at x = -8/15 (122.2 degrees), 1/4 - 5/32 - 2/15 =
// -0.039583, the mean being 1/4; negative where 15 x^2 + 16 x + 3 < 0, which is half of
// sqrt(76)/15 of the sphere.
TEST(LightQuality, OfALoneLightIsTheClosedForm) {
  const LightQuality quality = quality_of({DirectionalLight{kDirection, glm::dvec3(1.0)}}, 2, 32);
  const double least = 1.0 / 4 - 5.0 / 32 - 2.0 / 15;
  ASSERT_TRUE(quality.error && quality.least && quality.contrast && quality.dominant);
  EXPECT_NEAR(quality.error->relative_rms, 0.08839, 1e-4);
  EXPECT_NEAR(quality.least->value, 4 * least, 1e-10);
  EXPECT_NEAR(glm::dot(quality.least->direction, kDirection), -8.0 / 15, 1e-5);
  EXPECT_NEAR(quality.negative_fraction, std::sqrt(76.0) / 30, 1e-4);
  EXPECT_NEAR(*quality.contrast, (17.0 / 16 - least) / (17.0 / 16 + least), 0.002);
  ASSERT_EQ(quality.energy_shares.size(), 3U);
  for (int l = 0; l <= 2; ++l) EXPECT_NEAR(quality.energy_shares[l], (2 * l + 1) / 9.0, 1e-13);
  EXPECT_NEAR(glm::length(quality.mean - glm::dvec3(1 / (4 * std::numbers::pi))), 0.0, 1e-15);
  EXPECT_NEAR(glm::dot(quality.dominant->direction, kDirection), 1.0, 1e-14);
  EXPECT_NEAR(quality.dominant->irradiance.g, 1.0, 1e-13);
  EXPECT_NEAR(quality.dominant->energy_share, 1.0, 1e-13);
  EXPECT_NEAR(*quality.directionality, 1.0, 1e-13);
  EXPECT_NEAR(*quality.key_temperature, 6504, 5);
  EXPECT_EQ(quality.window_gains, std::vector<double>(3, 1.0));
}

TEST(LightQuality, OfAnEvenLightIsAllZerosAndOnes) {
  const LightQuality quality = quality_of({AmbientLight{glm::dvec3(2.0)}}, 3, 20);
  EXPECT_EQ(quality.degree, 3);
  EXPECT_EQ(quality.error->relative_rms, 0.0);
  EXPECT_EQ(quality.error->maximum, 0.0);
  EXPECT_EQ(quality.least->value, 1.0);
  EXPECT_EQ(quality.negative_fraction, 0.0);
  EXPECT_NEAR(*quality.contrast, 0.0, 1e-14);
  EXPECT_EQ(quality.energy_shares, (std::vector<double>{1.0, 0.0, 0.0, 0.0}));
  EXPECT_NEAR(quality.mean.r, 2.0, 1e-14);
  EXPECT_FALSE(quality.dominant);
  EXPECT_EQ(*quality.directionality, 0.0);
  EXPECT_FALSE(quality.key_temperature);
  EXPECT_NEAR(*quality.fill_temperature, 6504, 5);
}

// Ambient a and directional e: the fit to degree 2 takes e + a 4 pi/9 for the light, since
// sum_{l<=2} Y_lm(d)^2 = 9/(4 pi), and leaves a (1 - 1/9) as the residual's mean. So
// the fill has a's temperature whatever the key's is.
TEST(LightQuality, TellsKeyAndFillApart) {
  const glm::dvec3 sky(0.5, 0.7, 1.0), sun(5.0, 4.0, 2.8);
  for (const int degree : {2, 4}) {
    const LightQuality quality =
        quality_of({AmbientLight{sky}, DirectionalLight{kDirection, sun}}, degree, degree);
    const glm::dvec3 key = sun + sky * (4 * std::numbers::pi / 9);
    ASSERT_TRUE(quality.dominant && quality.key_temperature && quality.fill_temperature);
    EXPECT_NEAR(glm::length(quality.dominant->irradiance - key), 0.0, 1e-12);
    EXPECT_NEAR(*quality.key_temperature, *correlated_colour_temperature(key), 1e-7);
    EXPECT_NEAR(*quality.fill_temperature, *correlated_colour_temperature(sky), 1e-7);
    EXPECT_LT(*quality.key_temperature, 6504);
    EXPECT_GT(*quality.fill_temperature, 6504);
    EXPECT_FALSE(quality.error) << "nothing is known above the tables' degree";
  }
}

// A window changes what the tables' irradiance does, not what is said of the light.
TEST(LightQuality, LooksAtTheLightWithoutItsWindow) {
  const std::vector<AnalyticLight> lights = {DirectionalLight{kDirection, glm::dvec3(1.0)}};
  const std::vector<double> gains = {1.0, 0.75, 0.5};
  const Coefficients light = project_lights(lights, 20);
  const LightQuality plain = quality_of(lights, 2, 20);
  const LightQuality windowed = light_quality(apply_gains(truncate(light, 2), gains), gains, light);
  EXPECT_EQ(windowed.window_gains, gains);
  EXPECT_EQ(windowed.energy_shares, plain.energy_shares);
  EXPECT_EQ(windowed.directionality, plain.directionality);
  EXPECT_EQ(windowed.key_temperature, plain.key_temperature);
  EXPECT_GT(windowed.least->value, plain.least->value);
  EXPECT_LT(*windowed.contrast, *plain.contrast);
  EXPECT_GT(windowed.error->relative_rms, plain.error->relative_rms);
}

TEST(LightQuality, LeavesEmptyWhatALightDoesNotHave) {
  const LightQuality dark = light_quality(Coefficients(2), {1, 1, 1}, Coefficients(10));
  EXPECT_FALSE(dark.error || dark.contrast || dark.dominant || dark.directionality);
  EXPECT_FALSE(dark.key_temperature || dark.fill_temperature);
  EXPECT_TRUE(dark.energy_shares.empty());
  EXPECT_EQ(dark.negative_fraction, 0.0);

  Coefficients negative(1);
  for (auto& channel : negative.channels) channel[0] = -1.0;
  const LightQuality below = light_quality(negative, {1, 1}, negative);
  EXPECT_FALSE(below.least || below.contrast || below.directionality);
  EXPECT_NEAR(below.negative_fraction, 1.0, 1e-13);

  const LightQuality flat = quality_of({AmbientLight{glm::dvec3(1.0)}}, 0, 0);
  EXPECT_FALSE(flat.directionality) << "degree 0 tells nothing of it";
}

}  // namespace
}  // namespace shoal
