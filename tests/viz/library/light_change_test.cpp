#include "library/light_change.h"

#include <gtest/gtest.h>

#include <glm/matrix.hpp>

#include "library/changed_pixels.h"
#include "sphere/degree_window.h"
#include "sphere/dominant_light.h"
#include "sphere/linear_operations.h"
#include "sphere/rotation.h"
#include "sphere/turns.h"
#include "support/random_numbers.h"

namespace shoal::viz {
namespace {

// Channels that point to different sides, as those of most panoramas do.
Coefficients coloured_light(int degree, int seed = 3) {
  shoal::test::RandomNumbers random(seed);
  Coefficients light(degree);
  for (auto& channel : light.channels) {
    for (double& value : channel) value = random.between(-1.0, 1.0);
    channel[0] = 5.0 + random.between(0.0, 1.0);
  }
  return light;
}

Coefficients grey(Coefficients light) {
  light.channels[1] = light.channels[2] = light.channels[0];
  return light;
}

glm::dmat3 factors(double red, double green, double blue) {
  glm::dmat3 colour(1.0);
  colour[0][0] = red;
  colour[1][1] = green;
  colour[2][2] = blue;
  return colour;
}

double distance(const glm::dmat3& a, const glm::dmat3& b) {
  double sum = 0.0;
  for (int column = 0; column < 3; ++column) sum += glm::length(a[column] - b[column]);
  return sum;
}

void expect_found(const Coefficients& own, const Coefficients& told, const LightChange& expected) {
  const auto found = find_light_change(own, told);
  ASSERT_TRUE(found);
  EXPECT_LT(distance(found->colour, expected.colour), 1e-9);
  EXPECT_LT(distance(found->turn, expected.turn), 1e-9);
}

TEST(LightChange, IsNoneOfTheSameLightHoweverItIsWindowed) {
  const Coefficients own = coloured_light(5);
  EXPECT_EQ(find_light_change(own, own), LightChange{});
  const auto gains = window_gains({WindowKind::hann, {}}, 5);
  EXPECT_EQ(find_light_change(own, apply_gains(own, gains)), LightChange{});
  EXPECT_EQ(find_light_change(own, truncate(own, 2)), LightChange{});
}

// Each channel's factor, any rotation, and a window on top.
TEST(LightChange, OfFactorsAndARotationIsFound) {
  const glm::dmat3 colour = factors(0.25, 2.0, 0.125);
  const glm::dmat3 turn = *turn_matrix({70.0, -20.0, 33.0});
  for (const int degree : {1, 2, 9}) {
    const Coefficients own = coloured_light(degree);
    const Coefficients lit = apply_matrix(own, colour);
    expect_found(own, lit, {colour, glm::dmat3(1.0)});
    const Coefficients turned = rotate(lit, turn);
    expect_found(own, turned, {colour, turn});
    const auto gains = window_gains({WindowKind::hann, {}}, degree);
    expect_found(own, apply_gains(turned, gains), {colour, turn});
  }
}

// Degree 1 of grey light is one direction; what turns about the vertical keeps that one besides.
TEST(LightChange, OfGreyLightTurnedAboutTheVerticalIsFound) {
  const Coefficients own = grey(coloured_light(3));
  const glm::dmat3 yaw = *turn_matrix({110.0, 0.0, 0.0});
  expect_found(own, rotate(own, yaw), {glm::dmat3(1.0), yaw});
  EXPECT_FALSE(find_light_change(own, rotate(own, *turn_matrix({0.0, 40.0, 0.0}))));
}

TEST(LightChange, OfAnyMatrixIsFound) {
  const glm::dmat3 matrix(0.9, 0.05, 0.0, 0.1, 0.9, 0.1, 0.0, 0.05, 0.9);
  const Coefficients own = coloured_light(2);
  expect_found(own, apply_matrix(own, matrix), {matrix, glm::dmat3(1.0)});
  // Of grey light nobody can tell which matrix it was, but factors do the same to it.
  const auto found = find_light_change(grey(own), apply_matrix(grey(own), matrix));
  ASSERT_TRUE(found);
  EXPECT_NEAR(found->colour[1][1], 0.9 + 0.05 + 0.05, 1e-12);
  EXPECT_EQ(found->colour[0][1], 0.0);
}

TEST(LightChange, OfLightThatWasAddedOrTakenOutIsNotTold) {
  const Coefficients own = coloured_light(2);
  EXPECT_FALSE(find_light_change(own, add(own, coloured_light(2, 4))));
  EXPECT_FALSE(find_light_change(own, dominant_light(own, 2)->residual));
  EXPECT_FALSE(find_light_change(own, coloured_light(0)));
}

// By whole columns, or upside down, a turn moves texels to where others were.
TEST(TurnedPixels, AreTheSameTexelsElsewhere) {
  Pixels pixels{8, 4, std::vector<float>(3 * 8 * 4)};
  for (std::size_t i = 0; i < pixels.rgb.size(); ++i) pixels.rgb[i] = static_cast<float>(i);
  const Pixels right = turned(pixels, *turn_matrix({90.0, 0.0, 0.0}));
  // About the axis through the picture's centre: rows and columns run the other way.
  const Pixels over = turned(pixels, *turn_matrix({0.0, 0.0, 180.0}));
  for (int i = 0; i < 4; ++i) {
    for (int j = 0; j < 8; ++j) {
      for (int c = 0; c < 3; ++c) {
        EXPECT_NEAR(right.at(i, (j + 2) % 8)[c], pixels.at(i, j)[c], 1e-4) << i << ' ' << j;
        EXPECT_NEAR(over.at(3 - i, 7 - j)[c], pixels.at(i, j)[c], 1e-4) << i << ' ' << j;
      }
    }
  }
}

}  // namespace
}  // namespace shoal::viz
