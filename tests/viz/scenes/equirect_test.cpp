#include "scenes/equirect.h"

#include "library/changed_pixels.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "sphere/basis.h"
#include "support/random_numbers.h"

namespace shoal::viz {
namespace {

constexpr double kPi = std::numbers::pi;

glm::dvec3 direction_of(int row, int column, int width, int height) {
  const double theta = kPi * (row + 0.5) / height;
  const double phi = 2.0 * kPi * (column + 0.5) / width;
  return {std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi), std::cos(theta)};
}

Coefficients random_coefficients(int degree) {
  Coefficients coefficients(degree);
  shoal::test::RandomNumbers random(17);
  for (auto& channel : coefficients.channels) {
    for (double& value : channel) value = random.between(-1.0, 1.0);
  }
  return coefficients;
}

// The two differ by the rounding to float, 6e-8 of the value.
TEST(Synthesise, IsTheSumOfTheBasisAtEveryTexel) {
  for (const int degree : {0, 1, 2, 7, 20}) {
    const Coefficients coefficients = random_coefficients(degree);
    const int width = 24;
    const int height = 10;
    const Pixels pixels = synthesise(coefficients, width, height);
    ASSERT_EQ(pixels.rgb.size(), 3u * width * height);
    const double size = std::abs(*std::ranges::max_element(
        pixels.rgb, [](float a, float b) { return std::abs(a) < std::abs(b); }));
    for (int i = 0; i < height; ++i) {
      for (int j = 0; j < width; ++j) {
        const glm::dvec3 exact = evaluate(coefficients, direction_of(i, j, width, height));
        for (int c = 0; c < 3; ++c) ASSERT_NEAR(pixels.at(i, j)[c], exact[c], 1e-6 * size);
      }
    }
  }
}

// Up is the top row: Y_10 falls from row to row; Y_11 is largest at phi = 0, the left edge.
TEST(Synthesise, HasTheTopRowFirst) {
  Coefficients up(1);
  up.channels[0][coefficient_index(1, 0)] = 1.0;
  up.channels[1][coefficient_index(1, 1)] = 1.0;
  const Pixels pixels = synthesise(up, 16, 8);
  EXPECT_GT(pixels.at(0, 0)[0], 0.0f);
  EXPECT_LT(pixels.at(7, 0)[0], 0.0f);
  EXPECT_GT(pixels.at(4, 0)[1], 0.0f);
  EXPECT_LT(pixels.at(4, 8)[1], 0.0f);
}

std::vector<double> squares_of_basis(int width, int height, int l, int m) {
  std::vector<double> squares;
  const Basis<double> basis(l);
  std::vector<double> values(coefficient_count(l));
  for (int i = 0; i < height; ++i) {
    for (int j = 0; j < width; ++j) {
      basis.evaluate(direction_of(i, j, width, height), values);
      squares.push_back(std::pow(values[coefficient_index(l, m)], 2));
    }
  }
  return squares;
}

TEST(SphereMean, OfOneIsOne) {
  const Pixels like{32, 16, std::vector<float>(3 * 32 * 16)};
  EXPECT_NEAR(sphere_mean(like, std::vector<double>(32 * 16, 1.0)), 1.0, 1e-14);
}

// The integral of Y_lm^2 is 1, so its mean is 1/(4 pi). Columns are exact, being more than 2m. In a
// belt of height h a value counts as if it were that of the middle: by Taylor's formula that misses
// h^2/24 (2 f' cos + f'' sin), and a polynomial f of degree 2l has |f'| <= 2l max f and
// |f''| <= 4 l^2 max f (Bernstein), max Y_lm^2 <= (2l+1)/(4 pi). The mean misses at most
// h^2 (l + l^2)/6 max f, 1.1 for the terms beyond.
TEST(SphereMean, OfTheSquaredBasisIsOneOverFourPi) {
  const int width = 64;
  const int height = 128;
  const Pixels like{width, height, {}};
  for (int l = 0; l <= 5; ++l) {
    const double h = kPi / height;
    const double bound = 1.1 * h * h * (l + l * l) / 6.0 * (2 * l + 1) / (4.0 * kPi) + 1e-14;
    for (int m = -l; m <= l; ++m) {
      EXPECT_NEAR(sphere_mean(like, squares_of_basis(width, height, l, m)), 0.25 / kPi, bound)
          << l << ' ' << m;
    }
  }
}

// The inverse of (sin theta cos phi, sin theta sin phi, cos theta): theta down, phi to the right.
TEST(PlaceOf, IsWhereThePictureShowsADirection) {
  for (const auto& [across, down] : {std::pair(0.5, 0.5), {0.75, 0.5}, {0.1, 0.2}, {0.9, 0.95}}) {
    const double theta = kPi * down;
    const double phi = 2.0 * kPi * across;
    const glm::dvec2 place = place_of(
        {std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi), std::cos(theta)});
    EXPECT_NEAR(place.x, across, 1e-14);
    EXPECT_NEAR(place.y, down, 1e-14);
  }
  EXPECT_EQ(place_of({0.0, 0.0, 1.0}).y, 0.0);
  EXPECT_EQ(place_of({0.0, 0.0, -1.0}).y, 1.0);
}

}  // namespace
}  // namespace shoal::viz
