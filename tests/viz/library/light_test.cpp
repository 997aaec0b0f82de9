#include "library/light.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>
#include <vector>

#include "sphere/basis.h"

namespace shoal::viz {
namespace {

// Light of one colour from one direction u: coefficients Y_lm(u).
Coefficients light_from(const glm::dvec3& direction, const glm::dvec3& colour, int degree) {
  Coefficients light(degree);
  std::vector<double> basis(coefficient_count(degree));
  Basis<double>(degree).evaluate(direction, basis);
  for (int c = 0; c < kChannelCount; ++c) {
    for (std::size_t i = 0; i < basis.size(); ++i) light.channels[c][i] = colour[c] * basis[i];
  }
  return light;
}

// A constant environment of radiance c has L_00 = c sqrt(4 pi), and its mean is c.
TEST(Exposure, BringsTheMeanToItsTone) {
  Coefficients constant(2);
  for (auto& channel : constant.channels) channel[0] = 5.0 * std::sqrt(4.0 * std::numbers::pi);
  EXPECT_NEAR(glm::distance(mean_of(constant), glm::dvec3(5.0)), 0.0, 1e-14);
  EXPECT_NEAR(5.0 * automatic_exposure(constant), kMeanTone, 1e-14);
  EXPECT_EQ(automatic_exposure(constant, 1.0), 2.0 * automatic_exposure(constant));
  EXPECT_EQ(automatic_exposure(Coefficients(1)), 1.0);
}

// Degree 1 of a light from u is 3/(4 pi) (u . d), degree 0 1/(4 pi): Y_1m(u) = sqrt(3/(4 pi)) u.
TEST(Dominance, IsOneForOneDirection) {
  const Coefficients light = light_from({0.48, -0.6, 0.64}, {3.0, 1.0, 0.5}, 3);
  EXPECT_NEAR(*dominance_of(light), 1.0, 1e-14);
}

TEST(Dominance, IsZeroWhereOppositeSidesAreAlike) {
  Coefficients light = light_from({0.0, 0.6, 0.8}, {1.0, 1.0, 1.0}, 2);
  const Coefficients opposite = light_from({0.0, -0.6, -0.8}, {1.0, 1.0, 1.0}, 2);
  for (std::size_t i = 0; i < light.channels[0].size(); ++i) {
    for (int c = 0; c < kChannelCount; ++c) light.channels[c][i] += opposite.channels[c][i];
  }
  EXPECT_NEAR(*dominance_of(light), 0.0, 1e-15);
  EXPECT_FALSE(dominance_of(Coefficients(2))) << "black has none";
  EXPECT_FALSE(dominance_of(light_from({0.0, 0.0, 1.0}, {1.0, 1.0, 1.0}, 0)));
}

// 0.5 linear is 0.7354 in sRGB, and 0.04045 ends the straight piece (IEC 61966-2-1).
TEST(Srgb, IsTheStandardsCurveBothWays) {
  EXPECT_NEAR(srgb_encoded(0.5), 0.7354, 1e-4);
  EXPECT_NEAR(srgb_encoded(0.001), 0.01292, 1e-15);
  EXPECT_EQ(srgb_encoded(-1.0), 0.0);
  EXPECT_DOUBLE_EQ(srgb_encoded(7.0), 1.0);  // 1.055 - 0.055
  // The two pieces meet at 0.04045 but for the standard's rounding, 1e-7.
  for (int i = 0; i <= 1000; ++i) {
    EXPECT_NEAR(srgb_encoded(srgb_decoded(i / 1000.0)), i / 1000.0, 1e-7);
  }
}

}  // namespace
}  // namespace shoal::viz
