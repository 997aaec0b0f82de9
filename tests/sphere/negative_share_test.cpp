#include "sphere/negative_share.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <span>
#include <utility>
#include <vector>

#include "sphere/analytic_lights.h"
#include "sphere/irradiance.h"

namespace shoal {
namespace {

constexpr double kPi = std::numbers::pi;

// On a pole, on a row's direction, across the seam, anywhere.
const std::vector<glm::dvec3> kDirections = {
    {0, 0, 1}, {1, 0, 0}, {-0.6, 0.2, 0.5}, {0.3, -0.9, -0.1}, {0.01, 0.003, 1}};

std::vector<double> irradiance_of(const AnalyticLight& light, int degree) {
  return apply_quantity(project_lights(std::span(&light, 1), degree), Quantity::irradiance)
      .channels[0];
}

// The irradiance of a directional light of irradiance 1, to a degree, at the cosine x from it:
// sum A_l (2l+1)/(4 pi) P_l(x), by the recurrence of P_l.
double irradiance_at(double x, int degree) {
  double below = 1.0, p = x;
  double sum = clamped_cosine_gain(0) / (4 * kPi);
  for (int l = 1; l <= degree; ++l) {
    sum += clamped_cosine_gain(l) * (2 * l + 1) / (4 * kPi) * p;
    below = std::exchange(p, ((2 * l + 1) * x * p - l * below) / (l + 1));
  }
  return sum;
}

// Half the length in x of what is below zero: between zeros of a polynomial of that degree, which
// lie further than pi/1000 degree from one another, told apart on 20,000 angles, then halved.
double negative_share_of_ring(int degree) {
  constexpr int kCount = 20000;
  double sum = 0.0;
  double from = -1.0;
  for (int i = 1; i <= kCount; ++i) {
    const double to = std::cos(kPi * (kCount - i) / kCount);
    const bool is_negative = irradiance_at(from, degree) < 0.0;
    if (is_negative == (irradiance_at(to, degree) < 0.0)) {
      sum += is_negative ? to - from : 0.0;
    } else {
      double low = from, high = to;
      for (int k = 0; k < 60; ++k) {
        const double middle = (low + high) / 2;
        ((irradiance_at(middle, degree) < 0.0) == is_negative ? low : high) = middle;
      }
      sum += is_negative ? low - from : to - high;
    }
    from = to;
  }
  return sum / 2;
}

// To degree 2 that is where 15 x^2 + 16 x + 3 < 0 (light_quality_test.cpp): half of sqrt(76)/15.
TEST(NegativeShare, OfADirectionalLightsIrradiance) {
  EXPECT_NEAR(negative_share_of_ring(2), std::sqrt(76.0) / 30, 1e-13);
  for (const int degree : {1, 2, 3, 4, 5, 8, 10, 14, 20, 30, 45, 64}) {
    const double exact = negative_share_of_ring(degree);
    for (const glm::dvec3& direction : kDirections) {
      const AnalyticLight light = DirectionalLight{direction, glm::dvec3(1.0)};
      EXPECT_NEAR(negative_share(irradiance_of(light, degree), degree), exact,
                  degree <= 5 ? 5e-5 : 1.1e-4)
          << degree << " " << direction.x;
    }
  }
}

// a + cos(angle to d) is below zero on a cap of share (1 - a)/2. To degree 1 a directional light of
// irradiance 4 pi/3 is 1/3 + cos.
TEST(NegativeShare, OfACapIsItsSolidAngle) {
  for (const double level : {-0.999, -0.5, 0.0, 0.3, 0.9, 0.999}) {
    for (const glm::dvec3& direction : kDirections) {
      const std::vector<AnalyticLight> lights = {
          AmbientLight{glm::dvec3(level - 1.0 / 3)},
          DirectionalLight{direction, glm::dvec3(4 * kPi / 3)}};
      EXPECT_NEAR(negative_share(project_lights(lights, 1).channels[0], 1), (1 - level) / 2, 5e-5)
          << level << " " << direction.x;
    }
  }
}

TEST(NegativeShare, OfNothingOrOfAllOfTheSphere) {
  EXPECT_EQ(negative_share(std::vector{1.0, 0.1, 0.2, 0.3}, 1), 0.0);
  EXPECT_EQ(negative_share(std::vector{0.0, 0.0, 0.0, 0.0}, 1), 0.0);
  EXPECT_NEAR(negative_share(std::vector{-1.0, 0.1, 0.2, 0.3}, 1), 1.0, 1e-13);
}

}  // namespace
}  // namespace shoal
