#include "sphere/colour_temperature.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/mat3x3.hpp>
#include <limits>

namespace shoal {
namespace {

// Linear Rec.709 of a chromaticity, by the published matrix of IEC 61966-2-1 (4 digits).
glm::dvec3 rgb_of(double x, double y) {
  const glm::dvec3 xyz(x / y, 1.0, (1.0 - x - y) / y);
  const glm::dmat3 columns({3.2406, -0.9689, 0.0557}, {-1.5372, 1.8758, -0.2040},
                           {-0.4986, 0.0415, 1.0570});
  return columns * xyz;
}

// CIE 15:2018: illuminants with their temperatures.
TEST(ColourTemperature, IsThatOfTheStandardIlluminants) {
  EXPECT_NEAR(*correlated_colour_temperature({1, 1, 1}), 6504, 5) << "D65, Rec.709's white";
  EXPECT_NEAR(*correlated_colour_temperature(rgb_of(0.44757, 0.40745)), 2856, 15) << "A";
  EXPECT_NEAR(*correlated_colour_temperature(rgb_of(0.34567, 0.35850)), 5003, 15) << "D50";
  EXPECT_NEAR(*correlated_colour_temperature(rgb_of(0.33242, 0.34743)), 5503, 15) << "D55";
  EXPECT_NEAR(*correlated_colour_temperature(rgb_of(0.29902, 0.31485)), 7504, 25) << "D75";
  EXPECT_NEAR(*correlated_colour_temperature(rgb_of(0.31006, 0.31616)), 6774, 25) << "C";
}

// The locus of black bodies by Krystek's rational approximation ("An algorithm to calculate
// correlated colour temperature", Color Res. Appl. 10 (1985) 38), from 1000 K to 15,000 K to 8e-5
// in (u, v). There 1 MK^-1 is 1.5e-4 to 3e-4 long, so that it tells temperatures to about 0.5
// MK^-1.
TEST(ColourTemperature, FollowsTheLocusOfBlackBodies) {
  for (double kelvin = 1800; kelvin < 15000; kelvin *= 1.07) {
    const double t = kelvin;
    const double u = (0.860117757 + 1.54118254e-4 * t + 1.28641212e-7 * t * t) /
                     (1 + 8.42420235e-4 * t + 7.08145163e-7 * t * t);
    const double v = (0.317398726 + 4.22806245e-5 * t + 4.20481691e-8 * t * t) /
                     (1 - 2.89741816e-5 * t + 1.61456053e-7 * t * t);
    const double scale = 2 * u - 8 * v + 4;
    const auto found = correlated_colour_temperature(rgb_of(3 * u / scale, 2 * v / scale));
    ASSERT_TRUE(found) << kelvin;
    EXPECT_NEAR(1e6 / *found, 1e6 / kelvin, 0.8) << kelvin;
  }
}

TEST(ColourTemperature, DoesNotDependOnBrightness) {
  const glm::dvec3 colour(1.0, 0.7, 0.4);
  const double kelvin = *correlated_colour_temperature(colour);
  for (const double scale : {1e-6, 0.25, 3e4}) {
    EXPECT_NEAR(*correlated_colour_temperature(scale * colour), kelvin, 1e-9 * kelvin);
  }
}

TEST(ColourTemperature, IsNoneOfColoursThatNoBlackBodyHas) {
  for (const glm::dvec3& colour :
       {glm::dvec3(0, 1, 0), glm::dvec3(0, 0, 1), glm::dvec3(1, 0, 0), glm::dvec3(1, 0, 1),
        glm::dvec3(0, 0, 0), glm::dvec3(-1, -1, -1), glm::dvec3(0.2, 0.1, -3)}) {
    EXPECT_FALSE(correlated_colour_temperature(colour)) << colour.r << colour.g << colour.b;
  }
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE(correlated_colour_temperature({nan, 1, 1}));
  EXPECT_FALSE(correlated_colour_temperature({std::numeric_limits<double>::infinity(), 1, 1}));
}

}  // namespace
}  // namespace shoal
