#include "sphere/linear_operations.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "sphere/basis.h"
#include "sphere_samples.h"

namespace shoal {
namespace {

// Columns: where red, green and blue go.
const glm::dmat3 kMix(0.5, 0.25, 0.125, -0.5, 1.0, 2.0, 0.0, 0.75, 1.5);

// Rec.709's weights sum to 1, so grey is its own luminance; luminance is linear.
TEST(Luminance, IsRec709) {
  EXPECT_DOUBLE_EQ(luminance(glm::dvec3(3.0)), 3.0);
  EXPECT_DOUBLE_EQ(luminance(glm::dvec3(1.0, 0.0, 0.0)), 0.2126);
  EXPECT_DOUBLE_EQ(luminance(glm::dvec3(0.0, 0.0, 1.0)), 0.0722);
  const Coefficients coefficients = test::random_coefficients(2);
  for (int i = 0; i < 9; ++i) {
    EXPECT_DOUBLE_EQ(luminance(coefficients, i), 0.2126 * coefficients.channels[0][i] +
                                                     0.7152 * coefficients.channels[1][i] +
                                                     0.0722 * coefficients.channels[2][i]);
  }
}

TEST(ColourOperations, NothingAskedIsTheExactIdentity) {
  const auto matrix = combined_matrix({});
  ASSERT_TRUE(matrix.ok());
  EXPECT_EQ(*matrix, glm::dmat3(1.0));
  Coefficients coefficients = test::random_coefficients(6);
  coefficients.channels[1][3] = -0.0;
  const Coefficients same = apply_matrix(coefficients, *matrix);
  EXPECT_EQ(same, coefficients);
  EXPECT_TRUE(std::signbit(same.channels[1][3]));
}

TEST(ColourOperations, ExposureIsPowersOfTwoAndScaleMultiplies) {
  EXPECT_EQ(*combined_matrix({.exposure_stops = 3}), glm::dmat3(8.0));
  EXPECT_EQ(*combined_matrix({.exposure_stops = -1, .scale = 3}), glm::dmat3(1.5));
  EXPECT_DOUBLE_EQ((*combined_matrix({.exposure_stops = 0.5}))[2][2], std::sqrt(2.0));
}

// The white becomes the grey of its own luminance, so balancing keeps its luminance.
TEST(ColourOperations, WhiteBecomesGreyOfItsLuminance) {
  const glm::dvec3 white(1.2, 0.9, 0.4);
  const double luminance = 0.2126 * 1.2 + 0.7152 * 0.9 + 0.0722 * 0.4;
  const glm::dvec3 grey = *combined_matrix({.white = white}) * white;
  for (int c = 0; c < 3; ++c) EXPECT_NEAR(grey[c], luminance, 1e-15);
}

// White first, then the matrix, then scale and exposure.
TEST(ColourOperations, OrderIsWhiteMatrixScale) {
  const glm::dvec3 white(2.0, 1.0, 0.5);
  const double luminance = 0.2126 * 2.0 + 0.7152 + 0.0722 * 0.5;
  const ColourOperations all{.exposure_stops = 1, .scale = 3, .matrix = kMix, .white = white};
  const glm::dvec3 expected = 6.0 * (kMix * glm::dvec3(luminance));
  const glm::dvec3 found = *combined_matrix(all) * white;
  for (int c = 0; c < 3; ++c) EXPECT_NEAR(found[c], expected[c], 1e-14);
}

TEST(ColourOperations, RefusesWhatMakesNoSense) {
  for (double bad : {0.0, -1.0, std::numeric_limits<double>::infinity(), std::nan("")}) {
    const auto matrix = combined_matrix({.white = glm::dvec3(1.0, bad, 1.0)});
    ASSERT_FALSE(matrix.ok());
    EXPECT_EQ(matrix.error().code, ErrorCode::usage);
  }
  EXPECT_FALSE(combined_matrix({.exposure_stops = 2000}).ok());
  EXPECT_FALSE(combined_matrix({.scale = std::nan("")}).ok());
}

// Linear: applied to coefficients or to every value of the function, the same.
TEST(ApplyMatrix, CommutesWithEvaluation) {
  const Coefficients coefficients = test::random_coefficients(8);
  const Coefficients mixed = apply_matrix(coefficients, kMix);
  for (const glm::dvec3& d : test::random_directions(50)) {
    const glm::dvec3 expected = kMix * evaluate(coefficients, d);
    const glm::dvec3 found = evaluate(mixed, d);
    // 81 terms of size 1 to 3, in another order.
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(found[c], expected[c], 1e-13);
  }
}

TEST(ApplyMatrix, DiagonalOnlyMultiplies) {
  Coefficients coefficients = test::random_coefficients(4);
  // In a full product 0 * infinity would reach the other channels.
  coefficients.channels[0][5] = std::numeric_limits<double>::infinity();
  const glm::dmat3 diagonal(0.3, 0, 0, 0, 0.7, 0, 0, 0, 1.9);
  const Coefficients found = apply_matrix(coefficients, diagonal);
  for (int c = 0; c < kChannelCount; ++c) {
    for (std::size_t i = 0; i < found.channels[c].size(); ++i) {
      EXPECT_EQ(found.channels[c][i], coefficients.channels[c][i] * diagonal[c][c]);
    }
  }
}

TEST(Truncate, KeepsTheLowDegrees) {
  const Coefficients coefficients = test::random_coefficients(7);
  const Coefficients low = truncate(coefficients, 3);
  EXPECT_EQ(low.degree, 3);
  for (int c = 0; c < kChannelCount; ++c) {
    ASSERT_EQ(low.channels[c].size(), 16u);
    for (int i = 0; i < 16; ++i) EXPECT_EQ(low.channels[c][i], coefficients.channels[c][i]);
  }
  EXPECT_EQ(truncate(coefficients, 7), coefficients);
  EXPECT_EQ(truncate(coefficients, 20), coefficients);
}

}  // namespace
}  // namespace shoal
