#include "sphere/preetham_sky.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

#include "sphere/linear_operations.h"

namespace shoal {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr double kTurbidities[] = {2, 3, 4, 6, 8, 10};
constexpr double kElevations[] = {0, 1, 5, 15, 30, 45, 60, 75, 90};

PreethamSky sky_of(double turbidity, double elevation, double azimuth = 0.0) {
  return {turbidity, elevation, azimuth, glm::dvec3(0.2)};
}

// A direction by its angle from the zenith and its azimuth to the right of the centre, in degrees.
glm::dvec3 direction(double theta, double azimuth) {
  const double t = theta * kPi / 180, phi = kPi + azimuth * kPi / 180;
  return {std::sin(t) * std::cos(phi), std::sin(t) * std::sin(phi), std::cos(t)};
}

// The paper's zenith luminance, appendix A.2: in kcd/m^2, of T = 3 and the sun at 60 degrees from
// the zenith, chi = (4/9 - 3/120) 60 degrees = 25.1667 degrees:
//   (4.0453*3 - 4.9710) tan(25.1667 deg) - 0.2155*3 + 2.4192 = 7.1649*0.4698539 + 1.7727 = 5.13916.
TEST(PreethamSky, ZenithLuminance) {
  const PreethamModel model(sky_of(3, 30));
  EXPECT_NEAR(model.colour({0, 0, 1}).luminance, 5.13916, 1e-5);
  // Sun on the horizon: the tangent is zero.
  EXPECT_NEAR(PreethamModel(sky_of(4, 0)).colour({0, 0, 1}).luminance, 2.4192 - 4 * 0.2155, 1e-12);
}

// Numbers of an independent program (Python, straight from the appendix), at 30 and 89.9 degrees
// from the zenith.
TEST(PreethamSky, AgreesWithAnIndependentProgram) {
  const auto expect = [](const SkyColour& colour, double x, double y, double luminance) {
    EXPECT_NEAR(colour.x, x, 1e-12);
    EXPECT_NEAR(colour.y, y, 1e-12);
    EXPECT_NEAR(colour.luminance, luminance, 1e-12 * luminance);
  };
  expect(PreethamModel(sky_of(6, 90 - 72.9996)).colour(direction(30, 44.0935)), 0.28716862879273974,
         0.3020043075869559, 7.4979621992966505);
  expect(PreethamModel(sky_of(6, 90 - 72.9996, 100)).colour({0, 0, 1}), 0.2737703209794755,
         0.292810384818037, 5.728367019055229);
}

TEST(PreethamSky, TheSunIsWhereItIsToldToBe) {
  // The picture's centre is -x of the native frame, a quarter turn to its right -y.
  EXPECT_LT(glm::distance(sun_direction(sky_of(3, 0, 0)), glm::dvec3(-1, 0, 0)), 1e-15);
  EXPECT_LT(glm::distance(sun_direction(sky_of(3, 0, 90)), glm::dvec3(0, -1, 0)), 1e-15);
  EXPECT_LT(glm::distance(sun_direction(sky_of(3, 90, 33)), glm::dvec3(0, 0, 1)), 1e-15);
  EXPECT_LT(glm::distance(sun_direction(sky_of(3, 30, -120)), direction(60, -120)), 1e-15);
  // Around it the sky is brightest, as long as the horizon, which is brighter than all at low
  // turbidity, is not near.
  const PreethamModel model(sky_of(4, 50, 70));
  const double beside_sun = luminance(model.radiance(sun_direction(sky_of(4, 50, 70))));
  for (int theta = 1; theta < 80; theta += 3) {
    for (int azimuth = 0; azimuth < 360; azimuth += 7) {
      EXPECT_LE(luminance(model.radiance(direction(theta, azimuth))), beside_sun);
    }
  }
}

// The model depends on the angles to the zenith and to the sun only, so it is the same left and
// right of the sun's meridian, and turns with the sun.
TEST(PreethamSky, IsSymmetricAboutTheSunsMeridian) {
  const PreethamModel model(sky_of(3, 25, 40));
  const PreethamModel turned(sky_of(3, 25, -90));
  for (const double theta : {5.0, 40.0, 70.0, 89.0}) {
    for (const double off : {10.0, 60.0, 130.0, 175.0}) {
      const glm::dvec3 right = model.radiance(direction(theta, 40 + off));
      const glm::dvec3 left = model.radiance(direction(theta, 40 - off));
      const glm::dvec3 elsewhere = turned.radiance(direction(theta, off - 90));
      // A dozen roundings; exp(B/cos) feels those of cos near the horizon a hundredfold.
      EXPECT_LT(glm::distance(right, left), 1e-12 * glm::length(right));
      EXPECT_LT(glm::distance(right, elsewhere), 1e-12 * glm::length(right));
    }
  }
}

// Finite and not negative; and inside Rec.709 before anything is cut off, which shows as the
// luminance of the colour being that of the model. The one exception is the horizon under a sun
// that sets at a turbidity of 2: there blue is cut off, which is less than a five hundredth of its
// luminance.
TEST(PreethamSky, IsFiniteAndInsideTheGamutEverywhere) {
  for (const double turbidity : kTurbidities) {
    for (const double elevation : kElevations) {
      const PreethamModel model(sky_of(turbidity, elevation, 17));
      for (double theta = 0; theta <= 90; theta += 1.5) {
        for (int azimuth = 0; azimuth < 360; azimuth += 15) {
          glm::dvec3 d = direction(theta, azimuth);
          d.z = std::abs(d.z);
          const glm::dvec3 rgb = model.radiance(d);
          const double expected = model.colour(d).luminance;
          ASSERT_TRUE(std::isfinite(expected) && expected > 0.0);
          ASSERT_GE(std::min({rgb.r, rgb.g, rgb.b}), 0.0) << turbidity << " " << elevation;
          // Else the matrix to Rec.709 is undone to its rounding.
          const bool may_be_cut = turbidity == 2 && elevation <= 1 && theta > 85;
          ASSERT_NEAR(luminance(rgb), expected, (may_be_cut ? 2e-3 : 1e-12) * expected);
        }
      }
      const glm::dvec3 ground = model.radiance({0.6, 0, -0.8});
      EXPECT_EQ(ground, model.ground_radiance());
      EXPECT_GE(std::min({ground.r, ground.g, ground.b}), 0.0);
      const glm::dvec3 sun = model.sun_irradiance();
      EXPECT_TRUE(std::isfinite(luminance(sun)) && std::min({sun.r, sun.g, sun.b}) >= 0.0);
    }
  }
}

// exp(B/cos theta), B < 0, goes to zero with all its derivatives at the horizon: no seam there.
// Within a hundredth of a degree of it, cos theta <= 1.75e-4, it is below 1e-300.
TEST(PreethamSky, IsContinuousAtTheHorizon) {
  for (const double turbidity : kTurbidities) {
    const PreethamModel model(sky_of(turbidity, 20));
    for (const double azimuth : {0.0, 90.0, 180.0}) {
      glm::dvec3 at = direction(90, azimuth);
      for (const double z : {0.0, -0.0}) {
        at.z = z;
        const glm::dvec3 horizon = model.radiance(at);
        const glm::dvec3 above = model.radiance(direction(89.99, azimuth));
        // gamma changes by 1.7e-4 at most, and D is at most 2.6 (luminance).
        EXPECT_LT(glm::distance(horizon, above), 5e-4 * glm::length(horizon));
      }
    }
  }
}

// The irradiance by brute force on a grid of 0.2 degrees: midpoint sums, whose error of a smooth
// function is below 1e-5 here, and that of the kink at the sun as well.
TEST(PreethamSky, IrradianceIsTheIntegralOfRadiance) {
  const PreethamModel model(sky_of(3, 40, 25));
  glm::dvec3 sum(0.0);
  const double step = 0.2;
  for (double theta = step / 2; theta < 90; theta += step) {
    const double t = theta * kPi / 180;
    for (double azimuth = step / 2; azimuth < 360; azimuth += step) {
      sum += model.radiance(direction(theta, azimuth)) * (std::sin(t) * std::cos(t));
    }
  }
  sum *= (step * kPi / 180) * (step * kPi / 180);
  EXPECT_LT(glm::distance(sum, model.sky_irradiance()), 1e-4 * glm::length(sum));
  const glm::dvec3 on_ground =
      model.sky_irradiance() + model.sun_irradiance() * std::sin(40 * kPi / 180);
  EXPECT_LT(glm::distance(model.ground_radiance(), 0.2 / kPi * on_ground), 1e-13);
}

// What the paper and everybody's eyes say: haze whitens the sky, dims the sun, and the lower the
// sun the redder it is and the darker the sky.
TEST(PreethamSky, TrendsOfTurbidityAndElevation) {
  const auto blueness = [](const glm::dvec3& rgb) { return rgb.b / rgb.r; };
  for (std::size_t i = 0; i + 1 < std::size(kTurbidities); ++i) {
    const PreethamModel clear(sky_of(kTurbidities[i], 45)), hazy(sky_of(kTurbidities[i + 1], 45));
    EXPECT_GT(blueness(clear.radiance({0, 0, 1})), blueness(hazy.radiance({0, 0, 1})));
    EXPECT_GT(luminance(clear.sun_irradiance()), luminance(hazy.sun_irradiance()));
    EXPECT_GT(blueness(clear.sun_irradiance()), blueness(hazy.sun_irradiance()));
    EXPECT_LT(luminance(clear.radiance({0, 0, 1})), luminance(hazy.radiance({0, 0, 1})));
  }
  for (const double turbidity : kTurbidities) {
    for (std::size_t i = 1; i + 1 < std::size(kElevations); ++i) {
      const PreethamModel low(sky_of(turbidity, kElevations[i]));
      const PreethamModel high(sky_of(turbidity, kElevations[i + 1]));
      EXPECT_LT(luminance(low.sun_irradiance()), luminance(high.sun_irradiance()));
      // None is left of the blue of the lowest suns.
      EXPECT_LE(blueness(low.sun_irradiance()), blueness(high.sun_irradiance()));
      EXPECT_LT(luminance(low.radiance({0, 0, 1})), luminance(high.radiance({0, 0, 1})));
      // At a turbidity of 2 the bright horizon under low suns, a fault of the model, outweighs.
      if (turbidity == 2) continue;
      EXPECT_LT(luminance(low.sky_irradiance()), luminance(high.sky_irradiance()));
    }
  }
}

// Outside the atmosphere the sun gives 127.5 klx (IES) to 133.1 klx (ASTM E490-00a). Its colour is
// within 0.01 of x = 0.323, y = 0.331, that of a black body of 5900 K (Planck's law with the CIE
// 1931 functions). The air mass is Kasten's: 1 at the zenith, 2 at 30 degrees but for the curvature
// of the Earth, 37 on the horizon.
TEST(PreethamSky, SunlightIsThatOfTheSun) {
  const glm::dvec3 outside = sunlight(3, 0);
  EXPECT_GT(luminance(outside), 127.5);
  EXPECT_LT(luminance(outside), 133.1);
  const glm::dvec3 xyz(glm::dot(outside, {0.4124, 0.3576, 0.1805}), luminance(outside),
                       glm::dot(outside, {0.0193, 0.1192, 0.9505}));
  const double sum = xyz.x + xyz.y + xyz.z;
  EXPECT_NEAR(xyz.x / sum, 0.323, 0.01);
  EXPECT_NEAR(xyz.y / sum, 0.331, 0.01);
  EXPECT_NEAR(air_mass(90), 1.0, 1e-3);
  EXPECT_NEAR(air_mass(30), 2.0, 1e-2);
  EXPECT_NEAR(air_mass(0), 37.0, 1.0);
  // Each wavelength follows Beer's law, exp(-tau mass), so luminance, their sum with positive
  // weights, is convex in its logarithm: the red that is left is attenuated less and less.
  const auto through = [](double mass) { return luminance(sunlight(3, mass)); };
  EXPECT_LT(through(1), through(0));
  EXPECT_GT(through(0) * through(4), through(2) * through(2));
  // pi sin^2(radius) radiance is what a facing surface gets of a disk.
  const PreethamModel model(sky_of(3, 55));
  const DiskLight sun = model.sun();
  EXPECT_NEAR(sun.angular_radius * 180 / kPi, 0.2665, 1e-12);
  const double sine = std::sin(sun.angular_radius);
  EXPECT_LT(glm::distance(kPi * sine * sine * sun.radiance, model.sun_irradiance()), 1e-11);
}

TEST(PreethamSky, RefusesWhatItHasNoSkyFor) {
  EXPECT_TRUE(check_sky(sky_of(2, 0)));
  EXPECT_TRUE(check_sky(sky_of(10, 90, -400)));
  EXPECT_FALSE(check_sky(sky_of(1.9, 45)));
  EXPECT_FALSE(check_sky(sky_of(10.1, 45)));
  EXPECT_FALSE(check_sky(sky_of(NAN, 45)));
  EXPECT_FALSE(check_sky(sky_of(3, -0.1)));
  EXPECT_FALSE(check_sky(sky_of(3, 90.1)));
  EXPECT_FALSE(check_sky(sky_of(3, 45, INFINITY)));
  EXPECT_FALSE(check_sky({3, 45, 0, glm::dvec3(0.2, 0.2, 1.1)}));
  EXPECT_FALSE(check_sky({3, 45, 0, glm::dvec3(-0.1)}));
}

}  // namespace
}  // namespace shoal
