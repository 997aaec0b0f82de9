#include "sphere/zh3.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "oracle_panoramas.h"
#include "sphere/analytic_lights.h"
#include "sphere/basis.h"
#include "sphere/gauss_legendre.h"
#include "sphere/irradiance.h"
#include "sphere/linear_operations.h"
#include "sphere_samples.h"

namespace shoal {
namespace {

constexpr double kPi = std::numbers::pi;
const glm::dvec3 kDirection = glm::normalize(glm::dvec3(0.3, -1.2, 0.7));

Coefficients project(const std::vector<AnalyticLight>& lights, int degree) {
  return project_lights(lights, degree);
}

// ||a - b|| / ||b|| of irradiance over the sphere, channel by channel added up, where a ends at its
// own degree (Parseval).
double irradiance_error(const Coefficients& a, const Coefficients& b) {
  double off = 0.0, whole = 0.0;
  for (int c = 0; c < kChannelCount; ++c) {
    for (int l = 0; l <= b.degree; ++l) {
      for (int i = l * l; i < (l + 1) * (l + 1); ++i) {
        const double exact = clamped_cosine_gain(l) * b.channels[c][i];
        const double near = l <= a.degree ? clamped_cosine_gain(l) * a.channels[c][i] : 0.0;
        off += (near - exact) * (near - exact);
        whole += exact * exact;
      }
    }
  }
  return std::sqrt(off / whole);
}

// The same for the non-linear model, over 2000 directions.
double nonlinear_error(const Coefficients& radiance) {
  const Coefficients irradiance = apply_quantity(radiance, Quantity::irradiance);
  double off = 0.0, whole = 0.0;
  for (const glm::dvec3& d : test::random_directions(2000)) {
    const glm::dvec3 exact = evaluate(irradiance, d);
    const glm::dvec3 error = nonlinear_irradiance(radiance, d) - exact;
    off += glm::dot(error, error);
    whole += glm::dot(exact, exact);
  }
  return std::sqrt(off / whole);
}

// Lights of several colours about one axis: degree 2 is zonal about it in every channel.
TEST(Zh3, IsExactForZonalLight) {
  const Coefficients light =
      project({AmbientLight{{0.2, 0.1, 0.4}}, DiskLight{kDirection, 0.4, {5, 1, 0}},
               CosineLobe{-kDirection, {0, 0.5, 0.7}}},
              2);
  const QuadraticZonal found = fit_zh3(light);
  EXPECT_NEAR(std::abs(glm::dot(found.axis, kDirection)), 1.0, 1e-14);
  // Coefficients of size 2, an axis good to 1e-14.
  EXPECT_LT(test::largest_difference(expand(found), light), 5e-14);
}

// No other coefficients along the axis come nearer to degree 2, and what is missed is orthogonal to
// what is held.
TEST(Zh3, IsTheLeastSquaresFit) {
  const Coefficients light = test::random_coefficients(2);
  const QuadraticZonal found = fit_zh3(light);
  const double best = irradiance_error(expand(found), light);
  for (int c = 0; c < 3; ++c) {
    for (double change : {-1e-3, 1e-3}) {
      QuadraticZonal other = found;
      other.quadratic[c] += change;
      EXPECT_GT(irradiance_error(expand(other), light), best);
    }
  }
  EXPECT_LT(best, irradiance_error(truncate(light, 1), light));
}

// Z is sqrt(5/(16 pi)) (3 t^2 - 1) about the axis.
TEST(Zh3, ExpandsToTheZonalHarmonic) {
  QuadraticZonal light;
  light.axis = kDirection;
  light.quadratic = {1.0, 2.0, -1.0};
  const Coefficients expanded = expand(light);
  for (const glm::dvec3& d : test::random_directions(20)) {
    const double t = glm::dot(d, kDirection);
    const double z = std::sqrt(5 / (16 * kPi)) * (3 * t * t - 1);
    const glm::dvec3 found = evaluate(expanded, d);
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(found[c], light.quadratic[c] * z, 1e-15);
  }
}

// A directional light has L_00 : L_20 = 1 : sqrt(5) along its axis and r = sqrt(3), so that the
// guess is (0.08 sqrt(3) + 1.8) / sqrt(5) = 0.867 of the truth. Even light has r = 0 and no guess.
TEST(Zh3, HallucinatesFromDegreeOne) {
  const Coefficients sun = project({DirectionalLight{kDirection, {3, 2, 1}}}, 2);
  const QuadraticZonal guess = hallucinate_zh3(truncate(sun, 1));
  const QuadraticZonal truth = fit_zh3(sun);
  for (int c = 0; c < 3; ++c) {
    EXPECT_NEAR(guess.quadratic[c] / truth.quadratic[c],
                (0.08 * std::sqrt(3.0) + 1.8) / std::sqrt(5.0), 1e-14);
  }
  EXPECT_EQ(hallucinate_zh3(project({AmbientLight{{1, 1, 1}}}, 2)).quadratic, glm::dvec3(0.0));
  EXPECT_EQ(hallucinate_zh3(Coefficients(1)).quadratic, glm::dvec3(0.0));
}

// For caps of every size up to a hemisphere, alone or before a dim surrounding, the guess and the
// non-linear model come nearer to the truth, the sum to degree 32, than degree 1 alone.
TEST(Zh3, ComesNearerThanDegreeOneUnderCaps) {
  for (double radius : {0.05, 0.3, 0.6, 0.9, 1.2}) {
    for (double ambient : {0.0, 0.02}) {
      const Coefficients light = project({DiskLight{kDirection, radius, {1, 1, 1}},
                                          AmbientLight{glm::dvec3(ambient * radius * radius)}},
                                         32);
      const double plain = irradiance_error(truncate(light, 1), light);
      EXPECT_LT(irradiance_error(expand(fit_zh3(light)), light), plain) << radius;
      EXPECT_LT(irradiance_error(expand(hallucinate_zh3(light)), light), plain) << radius;
      EXPECT_LT(nonlinear_error(light), plain) << radius;
    }
  }
}

// Sum over t in [-1, 1], exactly for smooth functions.
template <typename Function>
double over_cosines(Function f) {
  const GaussRule rule = gauss_legendre(64);
  double sum = 0.0;
  for (std::size_t k = 0; k < rule.nodes.size(); ++k) {
    sum += static_cast<double>(rule.weights[k]) * f(static_cast<double>(rule.nodes[k]));
  }
  return sum;
}

// The mean irradiance is pi L_00/sqrt(4 pi), and E(d) - E(-d) = 4 pi |R1| along the vector, which
// are the truth's; a directional light gives its irradiance to a facing surface, nothing from
// behind. Nowhere negative.
TEST(NonlinearIrradiance, KeepsMeanAndDifference) {
  for (double directional : {0.0, 0.5, 2.0, 50.0}) {
    const Coefficients light =
        project({AmbientLight{{1, 1, 1}}, DirectionalLight{{0, 0, 1}, glm::dvec3(directional)}}, 1);
    const auto at = [&](double t) {
      return nonlinear_irradiance(light, {std::sqrt(1 - t * t), 0.0, t}).x;
    };
    // t^(1+2r) is not smooth at its end unless 2r is whole: 64 nodes give 1e-7.
    EXPECT_NEAR(over_cosines(at) / 2, kPi + directional / 4, 1e-6 * (1 + directional));
    EXPECT_NEAR(at(1.0) - at(-1.0), directional, 1e-13 * (1 + directional));
    for (int i = 0; i <= 100; ++i) EXPECT_GE(at(i / 50.0 - 1.0), 0.0);
  }
  const Coefficients sun = project({DirectionalLight{kDirection, {3, 2, 1}}}, 1);
  const glm::dvec3 facing = nonlinear_irradiance(sun, kDirection);
  const glm::dvec3 behind = nonlinear_irradiance(sun, -kDirection);
  for (int c = 0; c < 3; ++c) {
    EXPECT_NEAR(facing[c], 3.0 - c, 1e-14);
    EXPECT_NEAR(behind[c], 0.0, 1e-14);
  }
  EXPECT_EQ(nonlinear_irradiance(Coefficients(1), kDirection), glm::dvec3(0.0));
}

// Over real panoramas, truth being degree 8, of which irradiance beyond holds next to nothing.
TEST(Zh3, ComesNearerThanDegreeOneOnRealPanoramas) {
  SHOAL_REQUIRE_TEST_DATA(test::kOracleTable);
  double plain = 0.0, fitted = 0.0, guessed = 0.0, nonlinear = 0.0;
  const auto panoramas = test::oracle_panoramas();
  ASSERT_GT(panoramas.size(), 10u);
  for (const auto& [name, radiance] : panoramas) {
    const double one = irradiance_error(truncate(radiance, 1), radiance);
    const double zonal = irradiance_error(expand(fit_zh3(radiance)), radiance);
    EXPECT_LT(zonal, one) << name;
    plain += one;
    fitted += zonal;
    guessed += irradiance_error(expand(hallucinate_zh3(radiance)), radiance);
    nonlinear += nonlinear_error(radiance);
  }
  RecordProperty("plain", std::to_string(plain / panoramas.size()));
  RecordProperty("fitted", std::to_string(fitted / panoramas.size()));
  RecordProperty("guessed", std::to_string(guessed / panoramas.size()));
  RecordProperty("nonlinear", std::to_string(nonlinear / panoramas.size()));
  EXPECT_LT(fitted, guessed);
  EXPECT_LT(guessed, plain);
  EXPECT_LT(nonlinear, plain);
}

}  // namespace
}  // namespace shoal
