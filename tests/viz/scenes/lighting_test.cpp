#include "scenes/lighting.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

#include "scenes/equirect.h"
#include "sphere/basis.h"
#include "sphere/irradiance.h"
#include "support/random_numbers.h"

namespace shoal::viz {
namespace {

constexpr double kPi = std::numbers::pi;

glm::dvec3 random_direction(shoal::test::RandomNumbers& random) {
  const double z = random.between(-1.0, 1.0);
  const double phi = random.between(0.0, 2.0 * kPi);
  const double r = std::sqrt(1.0 - z * z);
  return {r * std::cos(phi), r * std::sin(phi), z};
}

Coefficients random_coefficients(int degree, shoal::test::RandomNumbers& random) {
  Coefficients coefficients(degree);
  for (auto& channel : coefficients.channels) {
    for (double& value : channel) value = random.between(-1.0, 1.0);
  }
  return coefficients;
}

// n^T M n is the polynomial that A_l L_lm Y_lm sums to; both are a dozen roundings of numbers
// below 10.
TEST(IrradianceForm, IsTheSumOfTheCoefficients) {
  shoal::test::RandomNumbers random(5);
  for (const int degree : {0, 1, 2, 4}) {
    const Coefficients radiance = random_coefficients(degree, random);
    const IrradianceForm form(radiance);
    Coefficients nine(2);
    for (int c = 0; c < kChannelCount; ++c) {
      for (std::size_t i = 0; i < 9 && i < radiance.channels[c].size(); ++i) {
        nine.channels[c][i] = radiance.channels[c][i];
      }
    }
    const Coefficients irradiance = apply_quantity(nine, Quantity::irradiance);
    for (int trial = 0; trial < 100; ++trial) {
      const glm::dvec3 normal = random_direction(random);
      const glm::dvec3 exact = evaluate(irradiance, normal);
      for (int c = 0; c < 3; ++c) ASSERT_NEAR(form.irradiance(normal)[c], exact[c], 1e-12);
    }
  }
}

// A texel's light counts as if it came from its centre. Over a texel of side h the mean of the
// cosine differs from that by at most h^2/12 of it, and along the horizon, where the cosine is cut,
// by at most h/8 over a belt of width h: in all below pi h^2/2.
constexpr int kWidth = 128;
constexpr double kTexelBound = 0.5 * kPi * (kPi / 64) * (kPi / 64);

TEST(TexelLight, OfAConstantPanoramaIsPi) {
  const Pixels pixels{kWidth, kWidth / 2, std::vector<float>(3 * kWidth * kWidth / 2, 1.0f)};
  const TexelLight light(pixels, glm::dmat3(1.0));
  shoal::test::RandomNumbers random(6);
  for (int trial = 0; trial < 50; ++trial) {
    const glm::dvec3 irradiance = light.irradiance(random_direction(random));
    for (int c = 0; c < 3; ++c) ASSERT_NEAR(irradiance[c], kPi, kTexelBound);
  }
}

// One bright texel lights a surface that faces it with its flux, and none that turns away.
TEST(TexelLight, OfOneTexelIsItsFluxTimesTheCosine) {
  Pixels pixels{16, 8, std::vector<float>(3 * 16 * 8, 0.0f)};
  const int row = 2;
  const int column = 5;
  pixels.rgb[3 * (row * 16 + column) + 1] = 7.0f;
  const double theta = kPi * (row + 0.5) / 8;
  const double phi = 2.0 * kPi * (column + 0.5) / 16;
  const glm::dvec3 native(std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi),
                          std::cos(theta));
  const double flux =
      7.0 * 2.0 * kPi / 16 * (std::cos(kPi * row / 8) - std::cos(kPi * (row + 1) / 8));
  for (const FrameAlias& alias : frame_aliases()) {
    const TexelLight light(pixels, native_to_frame(alias.frame));
    const glm::dvec3 towards = native_to_frame(alias.frame) * native;
    const glm::dvec3 across = glm::normalize(glm::cross(towards, glm::dvec3(0.3, 0.5, 0.7)));
    EXPECT_NEAR(light.irradiance(towards).g, flux, 1e-14);
    EXPECT_NEAR(light.irradiance(glm::normalize(towards + across)).g, flux * std::sqrt(0.5), 1e-14);
    EXPECT_EQ(light.irradiance(-towards).g, 0.0);
    EXPECT_EQ(light.irradiance(towards).r, 0.0);
  }
}

// The sum over all texels, as it is defined.
glm::dvec3 brute_force(const Pixels& pixels, const glm::dvec3& normal) {
  glm::dvec3 sum(0.0);
  for (int i = 0; i < pixels.height; ++i) {
    const double theta = kPi * (i + 0.5) / pixels.height;
    const double belt = std::cos(kPi * i / pixels.height) - std::cos(kPi * (i + 1) / pixels.height);
    for (int j = 0; j < pixels.width; ++j) {
      const double phi = 2.0 * kPi * (j + 0.5) / pixels.width;
      const glm::dvec3 direction(std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi),
                                 std::cos(theta));
      const double weight =
          2.0 * kPi / pixels.width * belt * std::max(0.0, glm::dot(direction, normal));
      const float* texel = pixels.at(i, j);
      sum += weight * glm::dvec3(texel[0], texel[1], texel[2]);
    }
  }
  return sum;
}

// Of a picture finer than the cells, even light of both signs: what the header says cells on the
// horizon add, h^2/4 of pi times the largest radiance.
TEST(TexelLight, OfCellsIsTheSumOverTheirTexels) {
  constexpr double kCell = 2.0 * kPi / 256;
  for (const double sign : {1.0, -1.0}) {
    Pixels pixels{600, 300, std::vector<float>(3 * 600 * 300)};
    for (std::size_t i = 0; i < pixels.rgb.size(); ++i) {
      pixels.rgb[i] = static_cast<float>(sign * (0.75 + 0.25 * std::sin(0.001 * double(i))));
    }
    const TexelLight light(pixels, glm::dmat3(1.0));
    shoal::test::RandomNumbers random(8);
    for (int trial = 0; trial < 20; ++trial) {
      const glm::dvec3 normal = random_direction(random);
      const glm::dvec3 difference = light.irradiance(normal) - brute_force(pixels, normal);
      for (int c = 0; c < 3; ++c) ASSERT_LT(std::abs(difference[c]), 0.25 * kCell * kCell * kPi);
    }
  }
}

// Light of one texel is the same however many share its cell, before and behind its horizon.
TEST(TexelLight, OfOneOfManyTexelsIsItsFluxTimesTheCosine) {
  Pixels pixels{1024, 512, std::vector<float>(3 * 1024 * 512, 0.0f)};
  pixels.rgb[3 * (131 * 1024 + 770)] = 1e5f;
  const TexelLight light(pixels, glm::dmat3(1.0));
  shoal::test::RandomNumbers random(9);
  for (int trial = 0; trial < 50; ++trial) {
    const glm::dvec3 normal = random_direction(random);
    const double expected = brute_force(pixels, normal).r;
    ASSERT_NEAR(light.irradiance(normal).r, expected, 1e-12 * 1e5);
  }
}

// Light of degree 2 is all that the nine coefficients hold, so both ways agree, in every frame.
// Its radiance is below 3 here.
TEST(TexelLight, AgreesWithTheFormWhereNothingIsLeftOut) {
  shoal::test::RandomNumbers random(7);
  Coefficients radiance = random_coefficients(2, random);
  for (auto& channel : radiance.channels) {
    for (double& value : channel) value *= 0.3;
    channel[0] = 4.0;
  }
  const Pixels pixels = synthesise(radiance, kWidth, kWidth / 2);
  for (const FrameAlias& alias : frame_aliases()) {
    const TexelLight texels(pixels, native_to_frame(alias.frame));
    const IrradianceForm form(to_frame(radiance, alias.frame));
    for (int trial = 0; trial < 10; ++trial) {
      const glm::dvec3 normal = random_direction(random);
      const glm::dvec3 difference = texels.irradiance(normal) - form.irradiance(normal);
      ASSERT_LT(glm::length(difference), 3.0 * kTexelBound) << alias.name;
    }
  }
}

}  // namespace
}  // namespace shoal::viz
