#include "sphere/dominant_light.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

#include "sphere/basis.h"
#include "sphere/linear_operations.h"
#include "sphere/rotation.h"
#include "sphere_samples.h"

namespace shoal {
namespace {

const glm::dvec3 kDirection = glm::normalize(glm::dvec3(0.3, -1.2, 0.7));

double square_norm(const Coefficients& coefficients) {
  double sum = 0.0;
  for (const auto& channel : coefficients.channels) {
    for (double value : channel) sum += value * value;
  }
  return sum;
}

Coefficients difference(const Coefficients& a, const Coefficients& b) {
  Coefficients result(a.degree);
  for (int c = 0; c < kChannelCount; ++c) {
    for (std::size_t i = 0; i < a.channels[c].size(); ++i) {
      result.channels[c][i] = a.channels[c][i] - b.channels[c][i];
    }
  }
  return result;
}

TEST(DominantLight, FindsALoneDirectionalLight) {
  const glm::dvec3 colour(3.0, 2.0, 0.5);
  for (int degree : {1, 2, 4, 10}) {
    const std::vector<AnalyticLight> lights = {DirectionalLight{kDirection, colour}};
    const Coefficients panorama = project_lights(lights, degree);
    const auto found = dominant_light(panorama);
    ASSERT_TRUE(found.has_value());
    for (int k = 0; k < 3; ++k) {
      EXPECT_NEAR(found->light.direction[k], kDirection[k], 1e-15);
      EXPECT_NEAR(found->light.irradiance[k], colour[k], 1e-14);
    }
    EXPECT_LT(std::sqrt(square_norm(found->residual)), 1e-13);
    EXPECT_NEAR(found->directionality, 1.0, 1e-15);
    EXPECT_NEAR(found->energy_share, 1.0, 1e-15);
  }
}

// Ambient light has no degree 1. To the sum of L_lm Y_lm(d) it adds L_00 Y_00 = 1 per unit of
// radiance, hence 4 pi/(n+1)^2 to the colour, n the degree of the fit. The luminance's vector is
// the directional light's irradiance, its mean times 4 pi that plus 4 pi times the ambient
// radiance.
TEST(DominantLight, AmbientLightAddsAKnownPart) {
  const double pi = std::numbers::pi;
  const glm::dvec3 colour(3.0, 2.0, 0.5), ambient(0.1, 0.2, 0.3);
  const std::vector<AnalyticLight> lights = {AmbientLight{ambient},
                                             DirectionalLight{kDirection, colour}};
  for (int degree : {1, 2, 4, 6}) {
    const auto found = dominant_light(project_lights(lights, degree));
    ASSERT_TRUE(found.has_value());
    const int used = std::min(degree, 2);
    for (int c = 0; c < 3; ++c) {
      EXPECT_NEAR(found->light.irradiance[c],
                  colour[c] + 4 * pi / ((used + 1) * (used + 1)) * ambient[c], 1e-13);
    }
    EXPECT_NEAR(found->directionality,
                luminance(colour) / (luminance(colour) + 4 * pi * luminance(ambient)), 1e-14);
  }
}

// What is above degree 2 has no part in the fit: the same bits, whatever it is.
TEST(DominantLight, IsTheSameAtEveryDegreeFromTwoOn) {
  const Coefficients panorama = test::random_coefficients(8);
  const auto expected = dominant_light(truncate(panorama, 2));
  ASSERT_TRUE(expected.has_value());
  for (int degree = 3; degree <= 8; ++degree) {
    const auto found = dominant_light(truncate(panorama, degree));
    ASSERT_TRUE(found.has_value());
    EXPECT_EQ(found->light.direction, expected->light.direction);
    EXPECT_EQ(found->light.irradiance, expected->light.irradiance);
    EXPECT_EQ(found->directionality, expected->directionality);
    EXPECT_EQ(found->energy_share, expected->energy_share);
    EXPECT_EQ(truncate(found->projected, 2), expected->projected);
    EXPECT_EQ(truncate(found->residual, 2), expected->residual);
  }
}

// light + residual gives every coefficient back, in double arithmetic.
TEST(DominantLight, LightAndResidualSumToThePanorama) {
  int exact = 0, all = 0;
  for (int degree : {1, 2, 3, 6, 10, 20}) {
    const Coefficients panorama = test::random_coefficients(degree);
    const auto found = dominant_light(panorama);
    ASSERT_TRUE(found.has_value());
    for (int c = 0; c < kChannelCount; ++c) {
      for (std::size_t i = 0; i < panorama.channels[c].size(); ++i) {
        const double whole = panorama.channels[c][i];
        const double light = found->projected.channels[c][i];
        const double sum = light + found->residual.channels[c][i];
        const double unit =
            std::nextafter(std::abs(light), std::numeric_limits<double>::infinity()) -
            std::abs(light);
        if (std::abs(light) <= std::abs(whole)) {
          EXPECT_EQ(sum, whole) << "degree " << degree << " index " << i;
        } else {
          EXPECT_LE(std::abs(sum - whole), unit) << "degree " << degree << " index " << i;
        }
        exact += sum == whole;
        ++all;
      }
    }
  }
  EXPECT_GT(exact, all * 9 / 10);
}

// What is called projected is the light's own projection, to a rounding of the residual.
TEST(DominantLight, ProjectedIsTheLightsProjection) {
  const Coefficients panorama = test::random_coefficients(8);
  const auto found = dominant_light(panorama);
  ASSERT_TRUE(found.has_value());
  const std::vector<AnalyticLight> light = {found->light};
  EXPECT_LT(test::largest_difference(found->projected, project_lights(light, 8)), 1e-15);
}

// No other colour of that direction leaves less to degree 2, channel by channel; one that would
// have to be negative is black.
TEST(DominantLight, ColourIsTheLeastSquaresOne) {
  Coefficients panorama = test::random_coefficients(4);
  for (int i = 0; i < coefficient_count(4); ++i) {
    panorama.channels[1][i] = std::abs(panorama.channels[1][i]);
  }
  const auto found = dominant_light(panorama);
  ASSERT_TRUE(found.has_value());
  const double best = square_norm(truncate(found->residual, 2));
  int black = 0;
  for (int c = 0; c < 3; ++c) {
    black += found->light.irradiance[c] == 0.0;
    for (double change : {-0.01, 0.01}) {
      DirectionalLight other = found->light;
      other.irradiance[c] += change;
      if (other.irradiance[c] < 0.0) continue;
      const std::vector<AnalyticLight> lights = {other};
      EXPECT_GT(square_norm(truncate(difference(panorama, project_lights(lights, 4)), 2)), best);
    }
  }
  EXPECT_LT(black, 3);
  EXPECT_NEAR(found->energy_share, 1.0 - best / square_norm(truncate(panorama, 2)), 1e-14);
}

TEST(DominantLight, NegativeColoursAreBlack) {
  const std::vector<AnalyticLight> lights = {AmbientLight{glm::dvec3(1.0)},
                                             DirectionalLight{kDirection, {5.0, 5.0, -9.0}}};
  const auto found = dominant_light(project_lights(lights, 2));
  ASSERT_TRUE(found.has_value());
  EXPECT_GT(found->light.irradiance.x, 0.0);
  EXPECT_EQ(found->light.irradiance.z, 0.0);
}

// The direction turns with the light, colour and figures stay.
TEST(DominantLight, TurnsWithThePanorama) {
  const Coefficients panorama = test::random_coefficients(5);
  const glm::dmat3 permutation(0, 1, 0, 0, 0, 1, 1, 0, 0);
  const auto before = dominant_light(panorama);
  const auto after = dominant_light(rotate(panorama, permutation));
  ASSERT_TRUE(before && after);
  const glm::dvec3 expected = permutation * before->light.direction;
  for (int k = 0; k < 3; ++k) {
    EXPECT_NEAR(after->light.direction[k], expected[k], 1e-14);
    EXPECT_NEAR(after->light.irradiance[k], before->light.irradiance[k], 1e-14);
  }
  EXPECT_NEAR(after->directionality, before->directionality, 1e-13);
}

TEST(DominantLight, EvenLightHasNone) {
  EXPECT_FALSE(dominant_light(Coefficients(4)).has_value());
  EXPECT_FALSE(dominant_light(Coefficients(0)).has_value());
  const std::vector<AnalyticLight> ambient = {AmbientLight{glm::dvec3(1.0)}};
  Coefficients even = project_lights(ambient, 4);
  EXPECT_FALSE(dominant_light(even).has_value());
  even.channels[1][2] = 1e-14;  // what rounding leaves
  EXPECT_FALSE(dominant_light(even).has_value());
  even.channels[1][2] = 1e-6;
  EXPECT_TRUE(dominant_light(even).has_value());
  even.channels[1][2] = std::nan("");
  EXPECT_FALSE(dominant_light(even).has_value());
}

}  // namespace
}  // namespace shoal
