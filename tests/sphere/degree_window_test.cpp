#include "sphere/degree_window.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "sphere_samples.h"

namespace shoal {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr WindowKind kKinds[] = {WindowKind::none, WindowKind::hann, WindowKind::lanczos,
                                 WindowKind::gauss, WindowKind::laplacian};

TEST(DegreeWindow, NoneIsOne) {
  for (double gain : window_gains({}, 10)) EXPECT_EQ(gain, 1.0);
}

// cos(pi/3) = 1/2: to degree 2 the default Hann window is 1, 3/4, 1/4; sin(pi/3) / (pi/3) etc.
TEST(DegreeWindow, HannAndLanczosToDegreeTwo) {
  const auto hann = window_gains({WindowKind::hann}, 2);
  EXPECT_EQ(hann[0], 1.0);
  EXPECT_NEAR(hann[1], 0.75, 1e-16);
  EXPECT_NEAR(hann[2], 0.25, 1e-16);
  const auto lanczos = window_gains({WindowKind::lanczos}, 2);
  EXPECT_EQ(lanczos[0], 1.0);
  EXPECT_NEAR(lanczos[1], 3 * std::sqrt(3.0) / (2 * kPi), 1e-15);
  EXPECT_NEAR(lanczos[2], 3 * std::sqrt(3.0) / (4 * kPi), 1e-15);
}

TEST(DegreeWindow, WidthIsTheFirstDegreeThatIsGone) {
  for (WindowKind kind : {WindowKind::hann, WindowKind::lanczos}) {
    const auto gains = window_gains({kind, 4.0}, 8);
    for (int l = 0; l < 4; ++l) EXPECT_GT(gains[l], 0.0) << l;
    for (int l = 4; l <= 8; ++l) EXPECT_EQ(gains[l], 0.0) << l;
    EXPECT_GT(window_gains({kind}, 8)[8], 0.0);
  }
}

// With (L+1)/2 a whole degree the defaults can be seen to agree there.
TEST(DegreeWindow, DefaultsHalveTheMiddle) {
  for (int degree : {1, 3, 7, 63}) {
    const int middle = (degree + 1) / 2;
    for (WindowKind kind : {WindowKind::hann, WindowKind::gauss, WindowKind::laplacian}) {
      EXPECT_NEAR(window_gains({kind}, degree)[middle], 0.5, 1e-15) << name_of(kind);
    }
    EXPECT_NEAR(window_gains({WindowKind::lanczos}, degree)[middle], 2 / kPi, 1e-15);
  }
}

TEST(DegreeWindow, FallsFromOneAndStaysPositive) {
  for (WindowKind kind : kKinds) {
    for (int degree : {0, 1, 2, 5, 64}) {
      const auto gains = window_gains({kind}, degree);
      ASSERT_EQ(gains.size(), degree + 1u);
      EXPECT_EQ(gains[0], 1.0);
      for (int l = 1; l <= degree; ++l) {
        EXPECT_LE(gains[l], gains[l - 1]) << name_of(kind) << ' ' << l;
        EXPECT_GE(gains[l], 0.0) << name_of(kind) << ' ' << l;
      }
    }
  }
}

// The stated formulas, with parameters other than the defaults.
TEST(DegreeWindow, FormulasHold) {
  for (int l = 0; l <= 12; ++l) {
    const double eigenvalue = l * (l + 1.0);
    EXPECT_NEAR(window_gains({WindowKind::hann, 12.5}, 12)[l], (1 + std::cos(kPi * l / 12.5)) / 2,
                2e-16);
    EXPECT_NEAR(window_gains({WindowKind::gauss, 0.2}, 12)[l], std::exp(-0.02 * eigenvalue), 2e-16);
    EXPECT_NEAR(window_gains({WindowKind::laplacian, 0.01}, 12)[l],
                1 / (1 + 0.01 * eigenvalue * eigenvalue), 2e-16);
  }
  for (WindowKind kind : {WindowKind::gauss, WindowKind::laplacian}) {
    for (double gain : window_gains({kind, 0.0}, 12)) EXPECT_EQ(gain, 1.0);
  }
}

// Blurs follow one another: variances add.
TEST(DegreeWindow, GaussiansComposeByTheirVariances) {
  const auto once = window_gains({WindowKind::gauss, 0.3}, 20);
  const auto again = window_gains({WindowKind::gauss, 0.4}, 20);
  const auto both = window_gains({WindowKind::gauss, 0.5}, 20);
  for (int l = 0; l <= 20; ++l) EXPECT_NEAR(once[l] * again[l], both[l], 1e-15);
}

// The kernel sum of (2l+1)/(4 pi) g_l P_l(x) of the heat equation is positive everywhere; the sums
// that Hann's and Lanczos' windows stand for are not.
TEST(DegreeWindow, OnlyTheGaussianIsAPositiveKernel) {
  const auto least = [](const DegreeWindow& window) {
    const auto gains = window_gains(window, kMaxDegree);
    double lowest = 1e9;
    for (int i = 0; i <= 4000; ++i) {
      const double x = i / 2000.0 - 1.0;
      double below = 0.0, p = 1.0, sum = 0.0;
      for (int l = 0; l <= kMaxDegree; ++l) {
        sum += (2 * l + 1) / (4 * kPi) * gains[l] * p;
        const double next = ((2 * l + 1) * x * p - l * below) / (l + 1);
        below = p;
        p = next;
      }
      lowest = std::min(lowest, sum);
    }
    return lowest;
  };
  // At degree 64 the terms left out are below 1e-40.
  EXPECT_GT(least({WindowKind::gauss, 0.3}), -1e-14);
  EXPECT_LT(least({WindowKind::hann}), -1e-3);
  EXPECT_LT(least({WindowKind::lanczos}), -1e-3);
}

TEST(DegreeWindow, NamesReadBack) {
  for (WindowKind kind : kKinds) EXPECT_EQ(*parse_window_kind(name_of(kind)), kind);
  EXPECT_EQ(parameter_name(WindowKind::gauss), "sigma");
  const auto misspelt = parse_window_kind("han");
  ASSERT_FALSE(misspelt.ok());
  EXPECT_EQ(misspelt.error().code, ErrorCode::usage);
  EXPECT_EQ(misspelt.error().hint, "did you mean \"hann\"?");
  EXPECT_EQ(parse_window_kind("blackman-harris").error().hint,
            "use none, hann, lanczos, gauss or laplacian");
}

TEST(DegreeWindow, RefusesParametersOutOfRange) {
  const DegreeWindow bad[] = {{WindowKind::none, 1.0},           {WindowKind::hann, 0.0},
                              {WindowKind::hann, -1.0},          {WindowKind::lanczos, 0.0},
                              {WindowKind::gauss, -0.1},         {WindowKind::laplacian, -0.1},
                              {WindowKind::gauss, std::nan("")}, {WindowKind::hann, HUGE_VAL}};
  for (const DegreeWindow& window : bad) {
    const Status status = check_window(window);
    ASSERT_FALSE(status.ok()) << name_of(window.kind);
    EXPECT_EQ(status.error().code, ErrorCode::usage);
  }
  for (WindowKind kind : kKinds) {
    EXPECT_TRUE(check_window({kind}).ok());
    EXPECT_TRUE(kind == WindowKind::none || check_window({kind, 0.5}).ok());
  }
}

TEST(ApplyGains, MultipliesWholeDegreesAndKeepsBitsAtOne) {
  Coefficients given = test::random_coefficients(5);
  given.channels[1][7] = -0.0;
  const Coefficients same = apply_gains(given, std::vector<double>(6, 1.0));
  EXPECT_EQ(same, given);
  EXPECT_TRUE(std::signbit(same.channels[1][7]));
  const std::vector<double> gains = {1.0, 0.5, 0.25, 0.0, 2.0, -1.0, 7.0};
  const Coefficients cut = apply_gains(given, gains);
  for (int l = 0; l <= 5; ++l) {
    for (int i = l * l; i < (l + 1) * (l + 1); ++i) {
      for (int c = 0; c < kChannelCount; ++c) {
        EXPECT_EQ(cut.channels[c][i], given.channels[c][i] * gains[l]);
      }
    }
  }
}

}  // namespace
}  // namespace shoal
