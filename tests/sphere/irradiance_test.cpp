#include "sphere/irradiance.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "sphere/basis.h"
#include "sphere/gauss_legendre.h"
#include "sphere_samples.h"

namespace shoal {
namespace {

constexpr double kPi = std::numbers::pi;

// P_0 .. P_degree at x.
std::vector<double> legendre_polynomials(int degree, double x) {
  std::vector<double> p = {1.0, x};
  for (int l = 1; l < degree; ++l) p.push_back(((2 * l + 1) * x * p[l] - l * p[l - 1]) / (l + 1));
  return p;
}

// Irradiance of a directional light that puts 1 on a facing surface, at cos(angle) = x, from
// degrees to `degree`: sum of A_l (2l+1)/(4 pi) P_l(x).
double delta_light(int degree, double x) {
  const std::vector<double> p = legendre_polynomials(degree, x);
  double sum = 0.0;
  for (int l = 0; l <= degree; ++l) {
    sum += clamped_cosine_gain(l) * (2 * l + 1) / (4 * kPi) * p[l];
  }
  return sum;
}

TEST(ClampedCosine, IsTheRationalTableToDegree20) {
  const double even[] = {
      1.0,         0.25,         -1.0 / 24,      1.0 / 64,       -1.0 / 128,     7.0 / 1536,
      -3.0 / 1024, 33.0 / 16384, -143.0 / 98304, 143.0 / 131072, -221.0 / 262144};
  for (int k = 0; k <= 10; ++k) {
    EXPECT_DOUBLE_EQ(clamped_cosine_gain(2 * k), kPi * even[k]) << 2 * k;
    EXPECT_DOUBLE_EQ(quantity_gain(Quantity::irradiance_over_pi, 2 * k), even[k]) << 2 * k;
  }
  EXPECT_DOUBLE_EQ(clamped_cosine_gain(1), 2 * kPi / 3);
  for (int l = 3; l <= 63; l += 2) EXPECT_EQ(clamped_cosine_gain(l), 0.0) << l;
}

// A_l = 2 pi times the integral of x P_l(x) over [0, 1] (Funk-Hecke), exactly by Gauss-Legendre.
TEST(ClampedCosine, IsItsIntegralToDegree64) {
  const GaussRule rule = gauss_legendre(40);
  for (int l = 0; l <= kMaxDegree; ++l) {
    double sum = 0.0;
    for (std::size_t i = 0; i < rule.nodes.size(); ++i) {
      const double x = static_cast<double>((rule.nodes[i] + 1) / 2);
      sum += static_cast<double>(rule.weights[i]) / 2 * x * legendre_polynomials(l, x)[l];
    }
    // 40 terms of size up to 1/40 with 1e-15 rounding in P_l.
    EXPECT_NEAR(clamped_cosine_gain(l), 2 * kPi * sum, 2e-14) << l;
  }
}

// Parseval: the square norm of the clamped cosine is 2 pi/3; degree l holds A_l^2 (2l+1)/(4 pi) of
// it.
TEST(ClampedCosine, EnergyFractions) {
  const auto fraction = [](int degree) {
    double sum = 0.0;
    for (int l = 0; l <= degree; ++l) {
      sum += std::pow(clamped_cosine_gain(l), 2) * (2 * l + 1) / (4 * kPi);
    }
    return sum / (2 * kPi / 3);
  };
  EXPECT_DOUBLE_EQ(fraction(0), 3.0 / 8);
  EXPECT_DOUBLE_EQ(fraction(1), 7.0 / 8);
  EXPECT_DOUBLE_EQ(fraction(2), 127.0 / 128);
  EXPECT_DOUBLE_EQ(fraction(4), 511.0 / 512);
  // |A_l| ~ l^(-5/2): what is left falls like l^-3.
  EXPECT_GT(fraction(kMaxDegree), 1.0 - 1e-5);
  EXPECT_LT(fraction(kMaxDegree), 1.0);
}

// To degree 2 it is 3/32 + x/2 + 15/32 x^2: 17/16 facing, 3/32 at right angles where the truth is
// 0, least at x = -8/15, -19/480 = -0.039583.
TEST(DeltaLight, DegreeTwoIsItsParabola) {
  EXPECT_NEAR(delta_light(2, 1.0), 17.0 / 16, 1e-15);
  EXPECT_NEAR(delta_light(2, 0.0), 3.0 / 32, 1e-15);
  EXPECT_NEAR(delta_light(2, -8.0 / 15), -19.0 / 480, 1e-15);
  EXPECT_NEAR(std::acos(-8.0 / 15) * 180 / kPi, 122.2, 0.05);
  for (int i = -1000; i <= 1000; ++i) EXPECT_GE(delta_light(2, i / 1000.0), -19.0 / 480 - 1e-15);
}

// Facing value, least value and largest error against max(0, x), from 20001 points; the digits
// given.
TEST(DeltaLight, TableOfHigherDegrees) {
  struct Row {
    int degree;
    double facing, least, error;
  };
  const Row rows[] = {{1, 0.75, -0.25, 0.25},
                      {2, 1.0625, -0.039583, 0.09375},
                      {4, 0.96875, -0.03125, 0.058594},
                      {6, 1.019531, -0.015525, 0.042725},
                      {8, 0.986328, -0.013672, 0.033646},
                      {10, 1.010254, -0.009842, 0.027758},
                      {20, 0.995996, -0.005186, 0.014817}};
  for (const Row& row : rows) {
    double least = 1.0, error = 0.0;
    for (int i = 0; i <= 20000; ++i) {
      const double x = i / 10000.0 - 1.0;
      const double value = delta_light(row.degree, x);
      least = std::min(least, value);
      error = std::max(error, std::abs(value - std::max(0.0, x)));
    }
    EXPECT_NEAR(delta_light(row.degree, 1.0), row.facing, 6e-7) << row.degree;
    EXPECT_NEAR(least, row.least, 6e-7) << row.degree;
    EXPECT_NEAR(error, row.error, 6e-7) << row.degree;
  }
}

// Radiance 1 on the upper half: L_l0 = 2 pi sqrt((2l+1)/(4 pi)) times the integral of P_l over [0,
// 1], (P_(l-1)(0) - P_(l+1)(0))/(2l+1). Its irradiance at the pole is pi, and the sum over l
// reaches it: odd l > 1 have A_l = 0 and even l > 0 no light, so that degree 1 already holds it
// all. At the equator it is pi/2 for the same reason.
TEST(ClampedCosine, HemisphereGivesPiAtItsPole) {
  for (int degree : {1, 2, 8, 64}) {
    Coefficients light(degree);
    const std::vector<double> p = legendre_polynomials(degree + 1, 0.0);
    for (int l = 0; l <= degree; ++l) {
      const double integral = l == 0 ? 1.0 : (p[l - 1] - p[l + 1]) / (2 * l + 1);
      const double value = 2 * kPi * std::sqrt((2 * l + 1) / (4 * kPi)) * integral;
      for (auto& channel : light.channels) channel[coefficient_index(l, 0)] = value;
    }
    const Coefficients irradiance = apply_quantity(light, Quantity::irradiance);
    EXPECT_NEAR(evaluate(irradiance, {0, 0, 1}).x, kPi, 1e-14) << degree;
    EXPECT_NEAR(evaluate(irradiance, {1, 0, 0}).y, kPi / 2, 1e-14) << degree;
    EXPECT_NEAR(evaluate(irradiance, {0, 0, -1}).z, 0.0, 1e-14) << degree;
  }
}

// A cap of half angle 60 degrees has light in every degree; its exact irradiance at its axis is
// pi sin^2(60) = 3 pi/4, approached as the degree grows, with terms of order l^-3.
TEST(ClampedCosine, CapConvergesToItsIrradiance) {
  const double exact = 0.75 * kPi;
  double error[3];
  const int degrees[3] = {2, 8, 64};
  for (int k = 0; k < 3; ++k) {
    const std::vector<double> p = legendre_polynomials(degrees[k] + 1, 0.5);
    double sum = clamped_cosine_gain(0) / (4 * kPi) * 2 * kPi * 0.5;
    for (int l = 1; l <= degrees[k]; ++l) {
      sum += clamped_cosine_gain(l) / 2 * (p[l - 1] - p[l + 1]);
    }
    error[k] = std::abs(sum - exact);
  }
  EXPECT_LT(error[1], error[0]);
  EXPECT_LT(error[2], error[1]);
  EXPECT_LT(error[2], 1e-3 * exact);
}

TEST(Quantity, ConstantEnvironmentHasIrradiancePi) {
  Coefficients light(4);
  for (auto& channel : light.channels) channel[0] = std::sqrt(4 * kPi);
  const Coefficients irradiance = apply_quantity(light, Quantity::irradiance);
  const Coefficients over_pi = apply_quantity(light, Quantity::irradiance_over_pi);
  for (const glm::dvec3& d : test::random_directions(10)) {
    EXPECT_NEAR(evaluate(light, d).x, 1.0, 1e-15);
    EXPECT_NEAR(evaluate(irradiance, d).x, kPi, 1e-14);
    EXPECT_NEAR(evaluate(over_pi, d).x, 1.0, 1e-15);
  }
}

TEST(Quantity, MultipliesEveryOrderOfADegree) {
  const Coefficients light = test::random_coefficients(10);
  EXPECT_EQ(apply_quantity(light, Quantity::radiance), light);
  const Coefficients irradiance = apply_quantity(light, Quantity::irradiance);
  for (int l = 0; l <= 10; ++l) {
    for (int m = -l; m <= l; ++m) {
      const int i = coefficient_index(l, m);
      for (int c = 0; c < kChannelCount; ++c) {
        EXPECT_EQ(irradiance.channels[c][i], light.channels[c][i] * clamped_cosine_gain(l));
      }
    }
  }
}

TEST(Quantity, NamesReadBack) {
  for (Quantity q : {Quantity::radiance, Quantity::irradiance, Quantity::irradiance_over_pi}) {
    ASSERT_TRUE(parse_quantity(name_of(q)).ok());
    EXPECT_EQ(*parse_quantity(name_of(q)), q);
  }
  EXPECT_EQ(name_of(Quantity::irradiance_over_pi), "irradiance-over-pi");
  EXPECT_EQ(*parse_quantity("irradiance_over_pi"), Quantity::irradiance_over_pi);
  const auto misspelt = parse_quantity("irradance");
  ASSERT_FALSE(misspelt.ok());
  EXPECT_EQ(misspelt.error().code, ErrorCode::usage);
  EXPECT_EQ(misspelt.error().hint, "did you mean \"irradiance\"?");
  EXPECT_EQ(parse_quantity("candela-per-lumen").error().hint,
            "use radiance, irradiance or irradiance-over-pi");
}

}  // namespace
}  // namespace shoal
