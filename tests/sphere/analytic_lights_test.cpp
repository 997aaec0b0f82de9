#include "sphere/analytic_lights.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "sphere/basis.h"
#include "sphere/frame.h"
#include "sphere/gauss_legendre.h"
#include "sphere/irradiance.h"
#include "sphere/rotation.h"
#include "sphere_samples.h"

namespace shoal {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr int kDegree = 30;
const glm::dvec3 kColour(1.0, 0.5, 2.0);
const glm::dvec3 kSlanted(0.3, -1.2, 0.7);

// 2 pi times the integral over [from, 1] of f(t) P_l(t), by Gauss-Legendre. Exact for f of degree
// up to 2 * 64 - 1 - l. The interval's nodes are told as 1 - t, so that short ones lose nothing.
template <typename Function>
std::vector<double> quadrature_factors(long double one_minus_from, int degree, Function f) {
  const GaussRule rule = gauss_legendre(64);
  std::vector<long double> sums(degree + 1, 0);
  for (std::size_t k = 0; k < rule.nodes.size(); ++k) {
    const long double one_minus_t = one_minus_from * (1 - rule.nodes[k]) / 2;
    const long double t = 1 - one_minus_t;
    const long double weight = rule.weights[k] / 2 * one_minus_from * f(t);
    long double below = 0, p = 1;
    for (int l = 0; l <= degree; ++l) {
      sums[l] += weight * p;
      const long double next = ((2 * l + 1) * t * p - l * below) / (l + 1);
      below = p;
      p = next;
    }
  }
  std::vector<double> factors;
  for (long double sum : sums) {
    factors.push_back(static_cast<double>(2 * std::numbers::pi_v<long double> * sum));
  }
  return factors;
}

// L_lm of a light by quadrature over the sphere, in coordinates about its axis: Gauss-Legendre in
// the cosine over [from, 1], where the light is a polynomial, and equidistant azimuths, exact to
// degree 2 * kDegree. Independent of the Funk-Hecke and addition theorems.
Coefficients brute_force(const PaintableLight& light, const glm::dvec3& axis, double from) {
  const glm::dvec3 d = glm::normalize(axis);
  const glm::dvec3 u = glm::normalize(glm::cross(d, glm::dvec3(0.2, 0.4, 1.0)));
  const glm::dvec3 v = glm::cross(d, u);
  const GaussRule rule = gauss_legendre(40);
  const int azimuths = 2 * kDegree + 2;
  const Basis<long double> basis(kDegree);
  std::vector<long double> y(coefficient_count(kDegree));
  Coefficients sum(kDegree);
  for (std::size_t k = 0; k < rule.nodes.size(); ++k) {
    const double t = from + (1 - from) * static_cast<double>(1 + rule.nodes[k]) / 2;
    const double s = std::sqrt(1 - t * t);
    const double weight =
        static_cast<double>(rule.weights[k]) / 2 * (1 - from) * 2 * kPi / azimuths;
    for (int j = 0; j < azimuths; ++j) {
      const double phi = 2 * kPi * j / azimuths;
      const glm::dvec3 x = t * d + s * std::cos(phi) * u + s * std::sin(phi) * v;
      const glm::dvec3 radiance = radiance_at(light, x);
      basis.evaluate(glm::vec<3, long double>(x), y);
      for (int c = 0; c < kChannelCount; ++c) {
        for (std::size_t i = 0; i < y.size(); ++i) {
          sum.channels[c][i] += weight * radiance[c] * static_cast<double>(y[i]);
        }
      }
    }
  }
  return sum;
}

Coefficients project(const AnalyticLight& light, int degree = kDegree) {
  return project_lights(std::span(&light, 1), degree);
}

// Irradiance at angle arccos(x) from a directional light of irradiance 1, from degrees to `degree`.
double delta_light(const Coefficients& irradiance, double x) {
  return evaluate(irradiance, glm::dvec3(std::sqrt(1 - x * x), 0.0, x)).x;
}

TEST(AmbientLight, HasOnlyItsMean) {
  const Coefficients light = project(AmbientLight{kColour});
  for (int c = 0; c < kChannelCount; ++c) {
    EXPECT_DOUBLE_EQ(light.channels[c][0], std::sqrt(4 * kPi) * kColour[c]);
    for (int i = 1; i < coefficient_count(kDegree); ++i) EXPECT_EQ(light.channels[c][i], 0.0);
  }
}

// sum over m of Y_lm(d) Y_lm(x) = (2l+1)/(4 pi) P_l(d.x), so that irradiance to degree 2 is
// 3/32 + t/2 + 15/32 t^2 at t = d.x: 17/16 facing, 3/32 at right angles, least -19/480 at t =
// -8/15, 122.2 degrees away. In every direction d, not only at the pole.
TEST(DirectionalLight, DegreeTwoIsItsParabola) {
  for (const glm::dvec3& d : test::random_directions(20)) {
    const Coefficients irradiance =
        apply_quantity(project(DirectionalLight{3.0 * d, kColour}, 2), Quantity::irradiance);
    EXPECT_NEAR(evaluate(irradiance, d).x, 17.0 / 16, 1e-14);
    for (const glm::dvec3& x : test::random_directions(20)) {
      const double t = glm::dot(d, x);
      const glm::dvec3 expected = kColour * (3.0 / 32 + t / 2 + 15.0 / 32 * t * t);
      const glm::dvec3 found = evaluate(irradiance, x);
      for (int c = 0; c < 3; ++c) EXPECT_NEAR(found[c], expected[c], 1e-14);
    }
  }
  const Coefficients polar =
      apply_quantity(project(DirectionalLight{{0, 0, 1}, kColour}, 2), Quantity::irradiance);
  EXPECT_NEAR(delta_light(polar, 0.0), 3.0 / 32, 1e-15);
  EXPECT_NEAR(delta_light(polar, -8.0 / 15), -19.0 / 480, 1e-15);
  EXPECT_NEAR(delta_light(polar, std::cos(122.2 * kPi / 180)), -0.039583, 1e-6);
}

// Facing value, least value and its angle where it is known, largest error and relative RMS error
// against max(0, t), from 20001 points even in t; the digits given.
TEST(DirectionalLight, TableOfDegrees) {
  struct Row {
    int degree;
    double facing, least, error, rms;
  };
  const Row rows[] = {{1, 0.75, -0.25, 0.25, 0.35355},
                      {2, 1.0625, -0.039583, 0.09375, 0.08839},
                      {4, 0.96875, -0.03125, 0.058594, 0.04419},
                      {6, 1.019531, -0.015525, 0.042725, 0.02762},
                      {8, 0.986328, -0.013672, 0.033646, 0.01934},
                      {10, 1.010254, -0.009842, 0.027758, 0.01450},
                      {20, 0.995996, -0.005186, 0.014817, 0.00566}};
  for (const Row& row : rows) {
    const Coefficients irradiance = apply_quantity(
        project(DirectionalLight{{0, 0, 1}, kColour}, row.degree), Quantity::irradiance);
    double least = 1.0, error = 0.0, square_error = 0.0, square = 0.0;
    for (int i = 0; i <= 20000; ++i) {
      const double t = std::clamp(i / 10000.0 - 1.0, -1.0, 1.0);
      const double value = delta_light(irradiance, t);
      const double off = value - std::max(0.0, t);
      least = std::min(least, value);
      error = std::max(error, std::abs(off));
      square_error += off * off;
      square += std::max(0.0, t) * t;
    }
    EXPECT_NEAR(delta_light(irradiance, 1.0), row.facing, 6e-7) << row.degree;
    EXPECT_NEAR(least, row.least, 6e-7) << row.degree;
    EXPECT_NEAR(error, row.error, 6e-7) << row.degree;
    EXPECT_NEAR(std::sqrt(square_error / square), row.rms, 6e-6) << row.degree;
  }
}

TEST(DiskLight, FactorsAreTheirIntegral) {
  for (double degrees : {0.01, 0.25, 1.0, 10.0, 33.0, 60.0, 90.0, 120.0, 170.0, 179.99, 180.0}) {
    const double radius = degrees * kPi / 180;
    const long double half = std::sin(static_cast<long double>(radius) / 2);
    const auto expected =
        quadrature_factors(2 * half * half, kMaxDegree, [](long double) { return 1.0L; });
    const auto factors = cap_zonal_factors(radius, kMaxDegree);
    for (int l = 0; l <= kMaxDegree; ++l) {
      EXPECT_NEAR(factors[l], expected[l], 1e-15 * expected[0]) << degrees << " degree " << l;
    }
  }
}

// The textbook form, good where the cap is not small.
TEST(DiskLight, FactorsAreDifferencesOfLegendrePolynomials) {
  const double x = std::cos(1.0);
  const auto factors = cap_zonal_factors(1.0, kDegree);
  std::vector<double> p = {1.0, x};
  for (int l = 1; l <= kDegree; ++l) p.push_back(((2 * l + 1) * x * p[l] - l * p[l - 1]) / (l + 1));
  EXPECT_NEAR(factors[0], 2 * kPi * (1 - x), 1e-14);
  for (int l = 1; l <= kDegree; ++l) {
    EXPECT_NEAR(factors[l], 2 * kPi * (p[l - 1] - p[l + 1]) / (2 * l + 1), 1e-14) << l;
  }
}

// k_l / (pi sin^2 a) = 2 P_l'(cos a) / (l(l+1)) = 1 - (l-1)(l+2) a^2/8 + O(a^4), k_0 a quarter of
// a^2 above: a small disk that puts 1 on a facing surface is a directional light of irradiance 1.
// The differences of Legendre polynomials would lose all digits at a = 1e-9.
TEST(DiskLight, SmallOnesTendToADirectionalLight) {
  for (double radius : {1e-3, 0.25 * kPi / 180, 1e-6, 1e-9, 1e-100}) {
    const auto factors = cap_zonal_factors(radius, kMaxDegree);
    const double facing = kPi * std::sin(radius) * std::sin(radius);
    for (int l = 0; l <= kMaxDegree; ++l) {
      const double leading = l == 0 ? 0.25 : -(l - 1) * (l + 2) / 8.0;
      // The next term is below ((l+1) a)^4 / 20.
      EXPECT_NEAR(factors[l] / facing, 1.0 + leading * radius * radius,
                  std::pow((l + 1) * radius, 4) / 20 + 1e-15)
          << radius << " degree " << l;
    }
  }
}

TEST(DiskLight, OfRadiusPiIsAmbient) {
  const Coefficients disk = project(DiskLight{kSlanted, kPi, kColour});
  EXPECT_LT(test::largest_difference(disk, project(AmbientLight{kColour})), 1e-14);
  const PaintableLight painted = DiskLight{kSlanted, kPi, kColour};
  for (const glm::dvec3& x : test::random_directions(100))
    EXPECT_EQ(radiance_at(painted, x), kColour);
  EXPECT_EQ(radiance_at(painted, -glm::normalize(kSlanted)), kColour);
}

// Radiance 1 over a hemisphere: pi at its pole and pi/2 at its rim, exactly, from degree 1 on: even
// degrees above 0 hold none of it, odd ones above 1 no irradiance.
TEST(DiskLight, HemisphereGivesPi) {
  const glm::dvec3 d = glm::normalize(kSlanted);
  const glm::dvec3 rim = glm::normalize(glm::cross(d, glm::dvec3(0, 0, 1)));
  for (int degree : {1, 2, 8, kMaxDegree}) {
    const Coefficients irradiance = apply_quantity(
        project(DiskLight{kSlanted, kPi / 2, glm::dvec3(1.0)}, degree), Quantity::irradiance);
    EXPECT_NEAR(evaluate(irradiance, d).x, kPi, 1e-13) << degree;
    EXPECT_NEAR(evaluate(irradiance, rim).y, kPi / 2, 1e-13) << degree;
    EXPECT_NEAR(evaluate(irradiance, -d).z, 0.0, 1e-13) << degree;
  }
}

TEST(DiskLight, ProjectsAsItIsPainted) {
  for (double radius : {0.01, 0.5, kPi / 2, 2.5, kPi}) {
    const DiskLight light{kSlanted, radius, kColour};
    const Coefficients expected = brute_force(light, kSlanted, std::cos(radius));
    const Coefficients found = project(light);
    // k_0 max|Y_lm| 1e-13 of rounding in the double sums.
    const double scale = cap_zonal_factors(radius, 0)[0] * 2.0 * 2.3;
    EXPECT_LT(test::largest_difference(found, expected), 1e-13 * scale) << radius;
  }
}

TEST(DiskLight, HasASharpEdge) {
  const PaintableLight sun = DiskLight{{0, 0, 5}, 0.25 * kPi / 180, kColour};
  const auto at = [](double degrees) {
    return glm::dvec3(std::sin(degrees * kPi / 180), 0.0, std::cos(degrees * kPi / 180));
  };
  EXPECT_EQ(radiance_at(sun, at(0.2499999)), kColour);
  EXPECT_EQ(radiance_at(sun, at(0.2500001)), glm::dvec3(0.0));
}

// k_l is A_l: the integral of t P_l(t) over [0, 1].
TEST(CosineLobe, FactorsAreTheirIntegral) {
  const auto expected = quadrature_factors(1.0L, kMaxDegree, [](long double t) { return t; });
  const auto factors = zonal_factors(CosineLobe{{0, 0, 1}, kColour}, kMaxDegree);
  for (int l = 0; l <= kMaxDegree; ++l) EXPECT_NEAR(factors[l], expected[l], 2e-15) << l;
}

TEST(CosineLobe, ProjectsAsItIsPainted) {
  const CosineLobe light{kSlanted, kColour};
  EXPECT_LT(test::largest_difference(project(light), brute_force(light, kSlanted, 0.0)), 1e-12);
}

// A surface facing the lobe gets 2 pi times the integral of t^2 over [0, 1]. Terms fall like l^-4.
TEST(CosineLobe, FacingSurfaceGetsTwoThirdsPi) {
  const Coefficients irradiance =
      apply_quantity(project(CosineLobe{kSlanted, kColour}, kMaxDegree), Quantity::irradiance);
  EXPECT_NEAR(evaluate(irradiance, glm::normalize(kSlanted)).x, 2 * kPi / 3, 1e-4);
}

TEST(ProjectLights, SumsAreLinear) {
  const std::vector<AnalyticLight> lights = {
      AmbientLight{kColour}, DirectionalLight{{1, 2, 3}, {3, 2, 1}},
      DiskLight{{-1, 0, 1}, 0.3, {5, 5, 5}}, CosineLobe{{0, -1, 0}, {0.1, 0.2, 0.3}}};
  Coefficients sum(8);
  for (const AnalyticLight& light : lights) {
    const Coefficients one = project(light, 8);
    for (int c = 0; c < kChannelCount; ++c) {
      for (std::size_t i = 0; i < one.channels[c].size(); ++i) {
        sum.channels[c][i] += one.channels[c][i];
      }
    }
  }
  EXPECT_EQ(project_lights(lights, 8), sum);
  EXPECT_EQ(project_lights({}, 3), Coefficients(3));
}

// Turning the light and turning its coefficients are the same; the length of a direction does not
// matter.
TEST(ProjectLights, TurnsAsItsLightsTurn) {
  const Frame frame = *parse_frame("openexr");
  const glm::dmat3 to_native = glm::transpose(native_to_frame(frame));
  for (const AnalyticLight& light :
       {AnalyticLight(AmbientLight{kColour}), AnalyticLight(DirectionalLight{kSlanted, kColour}),
        AnalyticLight(DiskLight{kSlanted, 0.4, kColour}),
        AnalyticLight(CosineLobe{kSlanted, kColour})}) {
    const Coefficients native = project(turned(light, to_native), 12);
    EXPECT_LT(test::largest_difference(to_frame(native, frame), project(light, 12)), 1e-13);
  }
  EXPECT_LT(test::largest_difference(project(DirectionalLight{kSlanted * 1e200, kColour}),
                                     project(DirectionalLight{kSlanted * 1e-200, kColour})),
            1e-13);
}

TEST(PaintableLight, LeavesOutDirectionalOnes) {
  EXPECT_FALSE(paintable(DirectionalLight{kSlanted, kColour}).has_value());
  const auto lobe = paintable(CosineLobe{{0, 0, 2}, kColour});
  ASSERT_TRUE(lobe.has_value());
  EXPECT_EQ(radiance_at(*lobe, {0, 0, 1}), kColour);
  EXPECT_EQ(radiance_at(*lobe, {0.6, 0, 0.8}), 0.8 * kColour);
  EXPECT_EQ(radiance_at(*lobe, {0, 0.6, -0.8}), glm::dvec3(0.0));
  EXPECT_EQ(radiance_at(*paintable(AmbientLight{kColour}), {1, 0, 0}), kColour);
}

TEST(CheckLight, RefusesWhatMakesNoSense) {
  const double infinity = std::numeric_limits<double>::infinity();
  const glm::dvec3 up(0, 0, 1);
  const AnalyticLight bad[] = {AmbientLight{{1, infinity, 1}},
                               DirectionalLight{{0, 0, 0}, kColour},
                               DirectionalLight{{0, std::nan(""), 1}, kColour},
                               DirectionalLight{up, {std::nan(""), 0, 0}},
                               DiskLight{up, 0.0, kColour},
                               DiskLight{up, -0.1, kColour},
                               DiskLight{up, 3.2, kColour},
                               DiskLight{up, std::nan(""), kColour},
                               DiskLight{{infinity, 0, 0}, 0.1, kColour},
                               CosineLobe{{0, 0, 0}, kColour},
                               CosineLobe{up, {infinity, 0, 0}}};
  for (const AnalyticLight& light : bad) {
    const Status status = check_light(light);
    ASSERT_FALSE(status.ok());
    EXPECT_EQ(status.error().code, ErrorCode::usage);
    EXPECT_FALSE(status.error().hint.empty());
  }
  EXPECT_TRUE(check_light(AmbientLight{}).ok());
  EXPECT_TRUE(check_light(DirectionalLight{{1e-300, 0, 0}, {-1, 0, 0}}).ok());
  EXPECT_TRUE(check_light(DiskLight{up, kPi, kColour}).ok());
  EXPECT_TRUE(check_light(CosineLobe{up, kColour}).ok());
}

}  // namespace
}  // namespace shoal
