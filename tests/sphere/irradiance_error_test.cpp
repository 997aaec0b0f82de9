#include "sphere/irradiance_error.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>
#include <vector>

#include "sphere/analytic_lights.h"
#include "sphere/basis.h"
#include "sphere/degree_window.h"
#include "sphere/irradiance.h"
#include "sphere/linear_operations.h"

namespace shoal {
namespace {

const glm::dvec3 kDirection = glm::normalize(glm::dvec3(0.3, -0.5, 0.8));

Coefficients lone_light(int degree) {
  const AnalyticLight light = DirectionalLight{kDirection, glm::dvec3(1.0)};
  return project_lights(std::vector{light}, degree);
}

// Of E = max(0, cos), whose mean is 1/4: the square norm's share below degree 2 is 127/128, so the
// relative RMS error is sqrt(1/128) = 8.839 %; at right angles E_2 = 3/32 where E is zero. Degree
// 64 in place of E leaves out what irradiance_beyond(64) says: 0.06 % of the RMS, and E_64 itself
// at right angles.
TEST(IrradianceError, OfALoneLightIsTheClosedForm) {
  const auto error = irradiance_error(lone_light(2), lone_light(64));
  ASSERT_TRUE(error);
  EXPECT_EQ(error->degree, 64);
  EXPECT_NEAR(error->relative_rms, std::sqrt(1.0 / 128), 1e-4 * 0.08839);
  const double at_right_angles = 4 * (3.0 / 32) - irradiance_beyond(64).maximum;
  EXPECT_NEAR(error->maximum, at_right_angles, 0.01 * at_right_angles);
  EXPECT_NEAR(glm::dot(error->direction, kDirection), 0.0, 0.02);
}

// Turning a light turns its error with it: the largest one is the same wherever the grid's texels
// happen to lie.
TEST(IrradianceError, TheLargestOneDoesNotDependOnTheDirection) {
  const auto largest = [](const glm::dvec3& direction) {
    const std::vector<AnalyticLight> light = {DirectionalLight{direction, glm::dvec3(1.0)}};
    return irradiance_error(project_lights(light, 2), project_lights(light, 20))->maximum;
  };
  const double expected = largest({0, 0, 1});
  for (const glm::dvec3& direction :
       {glm::dvec3(1, 0.7, 1), glm::dvec3(-1, 0, 0), glm::dvec3(0.3, -0.5, 0.8)}) {
    EXPECT_NEAR(largest(direction), expected, 1e-12);
  }
}

// The tables of relative RMS and largest error of sums for max(0, cos) to degree l: computed from
// the exact rational A_l by an independent program.
TEST(IrradianceError, BeyondADegreeIsWhatALoneLightHolds) {
  const struct {
    int degree;
    double rms, maximum;
  } kTable[] = {{1, 0.35355, 0.25},     {2, 0.08839, 0.09375},  {4, 0.04419, 0.058594},
                {6, 0.02762, 0.042725}, {8, 0.01934, 0.033646}, {10, 0.01450, 0.027758},
                {20, 0.00566, 0.014817}};
  // In units of the mean instead of the RMS: sqrt(2 pi/3 / (4 pi)) is 4/sqrt(6) of the mean.
  for (const auto& row : kTable) {
    const IrradianceBeyond beyond = irradiance_beyond(row.degree);
    EXPECT_NEAR(beyond.root_mean_square, row.rms * 4 / std::sqrt(6.0), 2e-5) << row.degree;
    EXPECT_NEAR(beyond.maximum, 4 * row.maximum, 4e-6) << row.degree;
  }
}

// That the remainder of max(0, cos) is largest at right angles, which the bound rests on.
TEST(IrradianceError, TheRemainderIsLargestAtRightAngles) {
  std::vector<double> sum(4001, 0.0), before(4001, 0.0), legendre(4001, 1.0);
  for (int l = 0; l <= 64; ++l) {
    double largest = 0.0;
    for (int k = 0; k <= 4000; ++k) {
      const double x = k / 2000.0 - 1.0;
      if (l > 0) {
        const double next = ((2 * l - 1) * x * legendre[k] - (l - 1) * before[k]) / l;
        before[k] = legendre[k];
        legendre[k] = next;
      }
      sum[k] += clamped_cosine_gain(l) * (2 * l + 1) / (4 * std::numbers::pi) * legendre[k];
      largest = std::max(largest, std::abs(std::max(0.0, x) - sum[k]));
    }
    if (l < 2 || l % 2 == 1) continue;
    EXPECT_NEAR(4 * largest, irradiance_beyond(l).maximum, 1e-12) << l;
  }
}

TEST(IrradianceError, OfAnEvenLightIsZero) {
  const std::vector<AnalyticLight> even = {AmbientLight{glm::dvec3(0.2, 1.0, 3.0)}};
  const auto error = irradiance_error(project_lights(even, 2), project_lights(even, 20));
  ASSERT_TRUE(error);
  EXPECT_EQ(error->relative_rms, 0.0);
  EXPECT_EQ(error->maximum, 0.0);
  EXPECT_FALSE(irradiance_error(Coefficients(2), Coefficients(20))) << "no light, no error";
}

// With gain g at degree 1 alone: ||E - E'||^2 / ||E||^2 = (1-g)^2 (1/2) + 1/128 since degree 1
// holds half of max(0, cos)'s energy; to degree 64 within 1e-6.
TEST(IrradianceError, CountsWhatAWindowTakes) {
  const std::vector<double> gains = {1.0, 0.75, 1.0};
  const auto error = irradiance_error(apply_gains(lone_light(2), gains), lone_light(64));
  EXPECT_NEAR(error->relative_rms * error->relative_rms, 0.0625 / 2 + 1.0 / 128, 2e-6);
}

// Both ways on the same light of degree 12, whose irradiance the grid's quadrature squares exactly.
TEST(IrradianceError, ByAGridIsTheOneByParseval) {
  Coefficients light(12);
  for (int c = 0; c < kChannelCount; ++c) {
    for (std::size_t i = 0; i < light.channels[c].size(); ++i) {
      light.channels[c][i] = std::cos(3.0 * i + c) / (1.0 + i);
    }
    light.channels[c][0] = 5.0;
  }
  const Coefficients low = truncate(light, 3);
  const DirectionGrid grid = gauss_grid(13);
  const Coefficients irradiance = apply_quantity(light, Quantity::irradiance);
  std::vector<glm::dvec3> values;
  for (const glm::dvec3& direction : grid.directions) {
    values.push_back(evaluate(irradiance, direction));
  }
  const auto parseval = irradiance_error(low, light);
  const auto measured = irradiance_error(low, grid, values);
  ASSERT_TRUE(parseval && measured);
  EXPECT_NEAR(measured->relative_rms, parseval->relative_rms, 1e-13);
  EXPECT_LE(measured->maximum, parseval->maximum * 1.02);
  EXPECT_GE(measured->maximum, parseval->maximum * 0.8) << "its grid is coarser";
  EXPECT_EQ(measured->degree, 25);
}

}  // namespace
}  // namespace shoal
