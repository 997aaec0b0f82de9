#include "sphere/automatic_window.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <random>

#include "sphere/analytic_lights.h"
#include "sphere/basis.h"
#include "sphere/degree_window.h"
#include "sphere/irradiance.h"
#include "sphere/linear_operations.h"
#include "sphere_samples.h"

namespace shoal {
namespace {

constexpr double kPi = std::numbers::pi;

// Evenly over the sphere, by the golden angle.
std::vector<glm::dvec3> fibonacci_directions(int count) {
  std::vector<glm::dvec3> directions;
  for (int k = 0; k < count; ++k) {
    const double z = 1 - (2 * k + 1.0) / count;
    const double s = std::sqrt(1 - z * z), phi = k * kPi * (3 - std::sqrt(5.0));
    directions.emplace_back(s * std::cos(phi), s * std::sin(phi), z);
  }
  return directions;
}

// Least irradiance over many directions, each channel by its mean; of many panoramas at a time,
// because the basis is the dear part. Degrees to 8.
std::vector<double> least_on_lattice(const std::vector<Coefficients>& panoramas, int count) {
  std::vector<Coefficients> irradiance;
  for (const Coefficients& p : panoramas) {
    irradiance.push_back(apply_quantity(p, Quantity::irradiance));
  }
  std::vector<double> least(panoramas.size(), std::numeric_limits<double>::infinity());
  const Basis<double> basis(10);
  std::vector<double> y(coefficient_count(10));
  for (const glm::dvec3& d : fibonacci_directions(count)) {
    basis.evaluate(d, y);
    for (std::size_t p = 0; p < panoramas.size(); ++p) {
      const glm::dvec3 value = evaluate(irradiance[p], y);
      for (int c = 0; c < kChannelCount; ++c) {
        const double mean = irradiance[p].channels[c][0] * y[0];
        if (mean > 0.0) least[p] = std::min(least[p], value[c] / mean);
      }
    }
  }
  return least;
}

// The gains with one cut degree raised by 1 %, or from zero to 0.01.
std::vector<double> raised(std::vector<double> gains, int l) {
  gains[l] = gains[l] > 0.0 ? 1.01 * gains[l] : 0.01;
  return gains;
}

double least_with(const Coefficients& panorama, const std::vector<double>& gains) {
  return least_irradiance(apply_gains(panorama, gains))->value;
}

// Non-negative, and no cut degree can be raised alone.
void expect_tight(const Coefficients& panorama, const AutomaticWindow& window) {
  EXPECT_GE(window.after.value, -1e-12);
  for (int l = 0; l <= panorama.degree; ++l) {
    EXPECT_GE(window.gains[l], 0.0);
    EXPECT_LE(window.gains[l], 1.0);
    if (window.gains[l] < 0.999) {
      EXPECT_LT(least_with(panorama, raised(window.gains, l)), -2e-9)
          << "degree " << l << " of " << panorama.degree << ", gain " << window.gains[l];
    }
  }
  EXPECT_EQ(window.gains[0], 1.0);
}

Coefficients random_light(int seed, int degree) {
  std::mt19937_64 engine(seed);
  std::uniform_real_distribution<double> uniform(0.0, 1.0);
  std::normal_distribution<double> normal;
  std::vector<AnalyticLight> lights = {AmbientLight{glm::dvec3(0.01 * uniform(engine))}};
  for (int k = 0; k < 1 + seed % 4; ++k) {
    const glm::dvec3 direction(normal(engine), normal(engine), normal(engine));
    const glm::dvec3 colour(uniform(engine), uniform(engine), uniform(engine));
    lights.push_back(DiskLight{direction, 0.05 + 0.5 * uniform(engine), colour});
  }
  return project_lights(lights, degree);
}

TEST(LeastIrradiance, OfADirectionalLight) {
  for (const glm::dvec3& d : test::random_directions(20)) {
    const std::vector<AnalyticLight> light = {DirectionalLight{d, {3, 3, 3}}};
    // By its mean, 1/4: -19/480 at cosine -8/15 of degree 2; 1/4 - 1/2 of degree 1, behind.
    const auto two = least_irradiance(project_lights(light, 2));
    ASSERT_TRUE(two.ok());
    EXPECT_NEAR(two->value, -19.0 / 120, 1e-14);
    EXPECT_NEAR(glm::dot(two->direction, d), -8.0 / 15, 1e-6);
    const auto one = least_irradiance(project_lights(light, 1));
    ASSERT_TRUE(one.ok());
    EXPECT_NEAR(one->value, -1.0, 1e-14);
    EXPECT_NEAR(glm::dot(one->direction, d), -1.0, 1e-12);
  }
}

// Whatever the light, no direction of a lattice is lower, and its own direction shows the value.
TEST(LeastIrradiance, IsTheLeastOfMany) {
  for (int degree : {0, 1, 2, 3, 5, 8, 10}) {
    std::vector<Coefficients> panoramas;
    for (int seed = 0; seed < 10; ++seed) {
      Coefficients p = test::random_coefficients(degree);
      for (auto& channel : p.channels) channel[0] = 1.0 + seed;
      p = seed % 2 == 0 ? p : random_light(seed, degree);
      panoramas.push_back(p);
    }
    const auto lattice = least_on_lattice(panoramas, 20000);
    for (int seed = 0; seed < 10; ++seed) {
      const auto least = least_irradiance(panoramas[seed]);
      ASSERT_TRUE(least.ok());
      EXPECT_LE(least->value, lattice[seed] + 1e-12);
      EXPECT_GT(least->value, lattice[seed] - 1e-2);
      const Coefficients irradiance = apply_quantity(panoramas[seed], Quantity::irradiance);
      const double mean = irradiance.channels[least->channel][0] / std::sqrt(4 * kPi);
      EXPECT_NEAR(evaluate(irradiance, least->direction)[least->channel] / mean, least->value,
                  1e-13);
    }
  }
}

TEST(LeastIrradiance, WorksToTheLargestDegree) {
  const Coefficients light = random_light(3, kMaxDegree);
  const auto least = least_irradiance(light);
  ASSERT_TRUE(least.ok());
  const Coefficients irradiance = apply_quantity(light, Quantity::irradiance);
  for (const glm::dvec3& d : test::random_directions(3000)) {
    const glm::dvec3 value = evaluate(irradiance, d);
    for (int c = 0; c < 3; ++c) {
      EXPECT_GE(value[c] / (irradiance.channels[c][0] / std::sqrt(4 * kPi)), least->value - 1e-12);
    }
  }
}

TEST(LeastIrradiance, RefusesWhatHasNoPositiveMean) {
  Coefficients light = random_light(1, 3);
  light.channels[1][0] = 0.0;
  ASSERT_FALSE(least_irradiance(light).ok());
  EXPECT_EQ(least_irradiance(light).error().code, ErrorCode::usage);
  EXPECT_NE(least_irradiance(light).error().what.find("green"), std::string::npos);
  light.channels[1][0] = std::nan("");
  EXPECT_FALSE(fit_window(light).ok());
  light.channels[1].assign(16, 0.0);  // a dark channel counts for nothing
  EXPECT_TRUE(fit_window(light).ok());
  EXPECT_EQ(least_irradiance(Coefficients(4))->value, 0.0);
}

// By its mean the irradiance of a directional light to degree 2 is, with gains g1 and g2,
// 1 + 2 g1 t + (5/8) g2 (3 t^2 - 1), least at t = -8 g1/(15 g2), where it is
// 1 - 5 g2/8 - 8 g1^2/(15 g2). On the curve where that is zero the loss (4/3) (1-g1)^2 + (5/16)
// (1-g2)^2 has one minimum, found by halving its derivative's interval.
TEST(AutomaticWindow, DirectionalLightInClosedForm) {
  const auto g1_of = [](double g2) { return std::sqrt(15 * g2 / 8 * (1 - 5 * g2 / 8)); };
  const auto slope = [&](double g2) {
    const double g1 = g1_of(g2);
    const double g1_slope = 15.0 / 8 * (1 - 5 * g2 / 4) / (2 * g1);
    return -8.0 / 3 * (1 - g1) * g1_slope - 5.0 / 8 * (1 - g2);
  };
  double low = 0.3, high = 1.0;
  for (int k = 0; k < 100; ++k) {
    const double middle = (low + high) / 2;
    (slope(middle) < 0 ? low : high) = middle;
  }
  for (const glm::dvec3& d : test::random_directions(5)) {
    const std::vector<AnalyticLight> light = {DirectionalLight{d, {3, 1, 2}}};
    const auto window = fit_window(project_lights(light, 2));
    ASSERT_TRUE(window.ok());
    // The loss is flat: a tolerance of 1e-12 in irradiance leaves its root in the gains.
    EXPECT_NEAR(window->gains[1], g1_of(low), 1e-6);
    EXPECT_NEAR(window->gains[2], low, 1e-6);
    EXPECT_NEAR(window->before.value, -19.0 / 120, 1e-13);
    EXPECT_NEAR(window->after.value, 0.0, 1e-9);
    EXPECT_NEAR(glm::dot(window->after.direction, d), -8 * g1_of(low) / (15 * low), 1e-4);
  }
}

// To degree 1 it is 1 + 2 g t: g = 1/2. Degree 3 has no irradiance and keeps its gain.
TEST(AutomaticWindow, DegreeOneHalves) {
  const std::vector<AnalyticLight> light = {DirectionalLight{{1, 2, 3}, {1, 1, 1}}};
  const auto one = fit_window(project_lights(light, 1));
  ASSERT_TRUE(one.ok());
  EXPECT_NEAR(one->gains[1], 0.5, 1e-9);
  EXPECT_EQ(one->strongest_cut(), 1);
  // ||E||^2 = 1 + 4/3 in units of the mean, of which a quarter of 4/3 is lost.
  EXPECT_NEAR(one->change, std::sqrt(1.0 / 3 / (7.0 / 3)), 1e-8);
  const auto three = fit_window(project_lights(light, 3));
  ASSERT_TRUE(three.ok());
  EXPECT_EQ(three->gains[3], 1.0);
  EXPECT_NEAR(three->gains[1], fit_window(project_lights(light, 2))->gains[1], 1e-8);
}

TEST(AutomaticWindow, LeavesWhatIsNowhereNegative) {
  const std::vector<AnalyticLight> lights = {AmbientLight{{1, 1, 1}},
                                             CosineLobe{{1, 0, 0}, {1, 2, 3}}};
  for (int degree : {0, 1, 2, 8}) {
    const auto window = fit_window(project_lights(lights, degree));
    ASSERT_TRUE(window.ok());
    for (double gain : window->gains) EXPECT_EQ(gain, 1.0);
    EXPECT_EQ(window->strongest_cut(), 0);
    EXPECT_EQ(window->change, 0.0);
    EXPECT_GT(window->after.value, 0.0);
  }
  const auto dark = fit_window(Coefficients(3));
  ASSERT_TRUE(dark.ok());
  EXPECT_EQ(dark->gains, std::vector<double>(4, 1.0));
}

TEST(AutomaticWindow, IsTightOnMadeLight) {
  for (int degree : {1, 2, 3, 4, 6, 10}) {
    for (int seed = 0; seed < 12; ++seed) {
      const Coefficients panorama = random_light(seed, degree);
      const auto window = fit_window(panorama);
      ASSERT_TRUE(window.ok()) << degree << ' ' << seed;
      expect_tight(panorama, *window);
    }
  }
}

// At the minimum of a convex function over a convex set the slope towards any other member is not
// negative: -sum w_l (1 - g_l) (g'_l - g_l) >= 0. Members: any gains, drawn towards (1, 0, 0 ...)
// until nowhere negative, which shrinks 1 - E by the same factor.
TEST(AutomaticWindow, NoOtherGainsChangeLess) {
  std::mt19937_64 engine(5);
  std::uniform_real_distribution<double> uniform(0.0, 1.0);
  for (int seed = 0; seed < 8; ++seed) {
    const Coefficients panorama = random_light(seed, 6);
    const Coefficients irradiance = apply_quantity(panorama, Quantity::irradiance);
    const auto window = fit_window(panorama);
    ASSERT_TRUE(window.ok());
    for (int trial = 0; trial < 30; ++trial) {
      std::vector<double> other(7, 1.0);
      for (int l = 1; l <= 6; ++l) {
        other[l] = trial < 15 ? std::sqrt(uniform(engine))
                              : std::min(1.0, window->gains[l] + 0.05 * uniform(engine));
      }
      const double least = least_with(panorama, other);
      if (least < 0.0) {
        for (int l = 1; l <= 6; ++l) other[l] /= 1.0 - least;
      }
      double slope = 0.0, scale = 0.0;
      for (int l = 1; l <= 6; ++l) {
        double w = 0.0;
        for (const auto& channel : irradiance.channels) {
          for (int i = l * l; i < (l + 1) * (l + 1); ++i) w += channel[i] * channel[i];
        }
        slope -= w * (1 - window->gains[l]) * (other[l] - window->gains[l]);
        scale += w;
      }
      EXPECT_GE(slope, -1e-8 * scale) << seed << ' ' << trial;
    }
  }
}

TEST(AutomaticWindow, WorksToTheLargestDegree) {
  // Enough ambient light that only the deepest dips are negative.
  const glm::dvec3 colour(1, 0, 0);
  const std::vector<AnalyticLight> lights = {DirectionalLight{{1, 2, 3}, colour},
                                             AmbientLight{3e-4 * colour}};
  const Coefficients panorama = project_lights(lights, kMaxDegree);
  const auto window = fit_window(panorama);
  ASSERT_TRUE(window.ok());
  EXPECT_LT(window->before.value, 0.0);
  EXPECT_GE(window->after.value, -1e-12);
  const int l = window->strongest_cut();
  EXPECT_LT(least_with(panorama, raised(window->gains, l)), -2e-9);
}

}  // namespace
}  // namespace shoal
