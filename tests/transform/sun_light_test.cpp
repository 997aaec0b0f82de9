// Suns found in pixels, and the ledger of their energy.
#include "transform/sun_light.h"

#include <gmock/gmock.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <vector>

#include "bright_light_fixture.h"
#include "sphere/linear_operations.h"
#include "sphere/texel_geometry.h"

namespace shoal::test {
namespace {

// A sky of radiance 1 with a disk of radiance (1001, 501, 201) around d.
Picture sunny(int height, const glm::dvec3& d, double radius) {
  constexpr double kSunlight[] = {1001.0, 501.0, 201.0};
  return make_picture(2 * height, height, [&](int c, int i, int j) {
    const double theta = kPi * (i + 0.5) / height, phi = kPi * (j + 0.5) / height;
    const glm::dvec3 w(std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi),
                       std::cos(theta));
    return glm::dot(w, d) > std::cos(radius) ? kSunlight[c] : 1.0;
  });
}

// The disk wherever it lies: across the seam, over a pole, between. Of its rim's 40 texels of side
// h each is in or out: by chance that is 2 h^2 of its solid angle of 130 h^2 and moves the centroid
// by h/10, several times more where the grid is symmetric about the disk. A texel's sun is its
// sample less that times level/value, level 1 and value 1001.
TEST_F(BrightLight, FindsTheSunWhereverItIs) {
  constexpr double kRadius = 0.08;
  constexpr int kHeight = 256;
  for (const glm::dvec3 d : {glm::dvec3(1, 0, 0), glm::dvec3(0, 0, 1), glm::dvec3(0.02, 0.01, -1),
                             glm::dvec3(0.4, -0.5, 0.6)}) {
    const glm::dvec3 direction = glm::normalize(d);
    const auto path = write(sunny(kHeight, direction, kRadius), "sun");
    for (const SunSettings& settings : {SunSettings{0.003, 0.0}, SunSettings{0.0, 1.0}}) {
      const Projection result = project(path, sun_of(settings));
      ASSERT_TRUE(result.sun) << testing::PrintToString(result.warnings);
      const Sun& sun = *result.sun;
      EXPECT_LT(glm::length(sun.direction - direction), 0.3 * kPi / kHeight);
      EXPECT_NEAR(sun.angular_radius, kRadius, 0.1 * kRadius);
      EXPECT_EQ(sun.level, 1.0);
      const double solid_angle = 2.0 * kPi * (1.0 - std::cos(kRadius));
      EXPECT_NEAR(sun.solid_angle, solid_angle, 0.2 * solid_angle);
      const DiskLight disk = sun.disk();
      for (int c = 0; c < 3; ++c) {
        const double radiance = (c == 0 ? 1001.0 : c == 1 ? 501.0 : 201.0) * (1000.0 / 1001.0);
        EXPECT_NEAR(sun.flux[c] / sun.solid_angle, radiance, 1e-4);
        EXPECT_NEAR(disk.radiance[c], radiance, 0.2 * radiance);
        // The disk's is pi sin^2(a) of its radiance. That of texels told as points is larger by the
        // spread of a texel, solid_angle/(4 pi) of the flux.
        const double of_disk = kPi * std::pow(std::sin(disk.angular_radius), 2) * disk.radiance[c];
        EXPECT_NEAR(sun.irradiance[c] / of_disk, 1.0, std::pow(kPi / kHeight, 2) / (4 * kPi));
      }
      const double taken = luminance(sun.flux);
      EXPECT_NEAR(sun.share, taken / (taken + 4 * kPi), 0.002) << "the level behind is not 1";
    }
  }
}

// Radiance 1, and around d disks of a radius and a radiance each, that add up. A texel holds the
// mean over 16 x 16 places in it.
struct PaintedDisk {
  double radius;
  double radiance;
};
Picture disks(int height, const glm::dvec3& d, const std::vector<PaintedDisk>& painted) {
  constexpr int kPlaces = 16;
  const double side = kPi / height;
  const auto cosine = [&](double i, double j) {
    const double theta = side * i, phi = side * j;
    return glm::dot(d, glm::dvec3(std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi),
                                  std::cos(theta)));
  };
  return make_picture(2 * height, height, [&](int, int i, int j) {
    double sum = 0.0;
    for (const PaintedDisk& disk : painted) {
      const double reach = disk.radius + side;
      if (cosine(i + 0.5, j + 0.5) < std::cos(reach)) continue;
      int inside = 0;
      for (int k = 0; k < kPlaces * kPlaces; ++k) {
        inside += cosine(i + (k / kPlaces + 0.5) / kPlaces, j + (k % kPlaces + 0.5) / kPlaces) >
                  std::cos(disk.radius);
      }
      sum += disk.radiance * inside / (kPlaces * kPlaces);
    }
    return 1.0 + sum;
  });
}

// Painting moves what a texel of side h holds to its centre. With x_i the centres, c_i what of a
// texel's area w the disk covers and e_i from its centre to that part's, the disk's second moment
// is
//   sum c_i w |x_i|^2 + sum c_i w (2 x_i . e_i + |e_i|^2) + those of the parts about themselves.
// Whole texels have e = 0 and h^2/6 about themselves; the radius counts them with h^2/(2 pi), that
// is 0.015 h^2 less of a^2. On the rim c |e| is at most h/8, towards the centre, and at most 8 a/h
// + 4 texels lie on it: 2 a h^2 (h/8) (8 a/h + 4) of pi a^2 (a^2/2), or 1.3 h^2 (1 + h/(2 a)) of
// a^2. So
//   -0.02 h^2 < r^2 - a^2 < 1.5 h^2    for a >= 4 h,
// a radius right to 0.75 h^2/a.
TEST_F(BrightLight, ASunsRadiusIsThatOfThePaintedDisk) {
  for (const int height : {128, 256, 512}) {
    const double side = kPi / height;
    for (const double texels : {4.0, 5.5, 7.0}) {
      for (const glm::dvec3 d :
           {glm::dvec3(1, 0, 0), glm::dvec3(0.4, -0.5, 0.6), glm::dvec3(0.02, 0.01, -1)}) {
        const double radius = texels * side;
        const auto path = write(disks(height, glm::normalize(d), {{radius, 1000.0}}), "disk");
        const Projection result = project(path, sun_of({0.0, 1.0}));
        ASSERT_TRUE(result.sun) << testing::PrintToString(result.warnings);
        const double found = result.sun->angular_radius;
        EXPECT_GT(found * found, radius * radius - 0.02 * side * side) << height << " " << texels;
        EXPECT_LT(found * found, radius * radius + 1.5 * side * side) << height << " " << texels;
      }
    }
  }
}

// A sun of one texel is the cap of its solid angle.
TEST_F(BrightLight, ASunOfOneTexelIsAsLargeAsTheTexel) {
  Picture picture = make_picture(64, 32, [](int, int, int) { return 1.0; });
  for (int c = 0; c < 3; ++c) picture.at(c, 16, 20) = 100.0F;
  const Projection result = project(write(picture, "one"), sun_of({0.0, 2.0}));
  ASSERT_TRUE(result.sun);
  EXPECT_NEAR(2.0 * kPi * (1.0 - std::cos(result.sun->angular_radius)), result.sun->solid_angle,
              1e-12);
}

// Spreads add by their fluxes: a disk of spread s = 1 - cos(a) that gives F, in one of spread t
// that gives G, has (F s + G t)/(F + G), whatever the texels above the level cover: here the larger
// one and the texels on its rim, three times r. The texels add as above, to either.
TEST_F(BrightLight, AFaintGlowIsNotTheSun) {
  constexpr int kHeight = 512;
  constexpr double kSun = 0.03, kGlow = 0.15, kSunlight = 5000.0, kGlowLight = 4.0;
  const double side = kPi / kHeight;
  const auto path =
      write(disks(kHeight, {0, -1, 0}, {{kSun, kSunlight}, {kGlow, kGlowLight}}), "glow");
  const Projection result = project(path, sun_of({0.0, 1.0}));
  ASSERT_TRUE(result.sun) << testing::PrintToString(result.warnings);
  const double sun = 1.0 - std::cos(kSun), glow = 1.0 - std::cos(kGlow);
  const double spread =
      (kSunlight * sun * sun + kGlowLight * glow * glow) / (kSunlight * sun + kGlowLight * glow);
  const double square = std::pow(std::acos(1.0 - spread), 2);
  EXPECT_LT(square, kGlow * kGlow / 9.0) << "the two are told apart";
  const double found = result.sun->angular_radius;
  EXPECT_GT(found * found, square - 0.02 * side * side);
  EXPECT_LT(found * found, square + 1.5 * side * side);
  EXPECT_NEAR(result.sun->solid_angle, 2.0 * kPi * glow, 0.1 * 2.0 * kPi * glow);
}

struct Sunny {
  Picture picture;
  std::int64_t sun_texels = 0;
};

// A sky of radiance 1 with a sun of 1000 and another of 900 on the other side, in any layout.
Sunny two_suns(Layout layout, int edge, const glm::dvec3& direction, double radius) {
  const LayoutSize size = size_of(layout, edge);
  const auto geometry = TexelGeometry::create(layout, size.width, size.height);
  EXPECT_TRUE(geometry);
  Sunny sunny{Picture(size.width, size.height), 0};
  for (int row = 0; row < size.height; ++row) {
    const TexelSpan span = geometry->span_of({row, 0, 0, 1, size.width});
    for (int column = span.begin; column < span.end; ++column) {
      const double cosine = glm::dot(geometry->texel(row, column).direction, direction);
      const bool is_sun = cosine > std::cos(radius);
      const bool is_other = -cosine > std::cos(radius);
      if (is_sun) ++sunny.sun_texels;
      for (int c = 0; c < 3; ++c) {
        sunny.picture.at(c, row, column) = is_sun ? 1000.0F : is_other ? 900.0F : 1.0F;
      }
    }
  }
  return sunny;
}

// In every layout all texels of a sun are one region and no other's are, on a face's edge and on
// its corner, on the folds, behind a disc, where all of its rim meets; and its light, put back as a
// disk, is what was taken. Directions and sizes are those of the disk to a texel, 2 pi over the
// texels around, but behind a disc, of which its rim shows only some.
TEST_F(BrightLight, FindsTheSunInEveryLayout) {
  constexpr double kRadius = 0.09;
  for (const auto& [name, layout] : kLayoutNames) {
    if (layout == Layout::automatic || layout == Layout::equirect || layout == Layout::cube_faces) {
      continue;
    }
    for (const glm::dvec3 d :
         {glm::dvec3(1, 1, 1), glm::dvec3(-1, -1, 1), glm::dvec3(1, 0.02, 0), glm::dvec3(0, 0, -1),
          glm::dvec3(0, 1, 1), glm::dvec3(0.03, -1, 0.02), glm::dvec3(-1, 0, -1),
          glm::dvec3(-0.5, 0.3, 0.2), glm::dvec3(0.6, 0.5, -0.01)}) {
      SCOPED_TRACE(std::string(name) + " " + testing::PrintToString(std::vector{d.x, d.y, d.z}));
      const glm::dvec3 direction = glm::normalize(d);
      const Sunny sunny = two_suns(layout, 96, direction, kRadius);
      const auto path = write(sunny.picture, "sun");
      ProjectionSettings settings = sun_of({});
      settings.layout = layout;
      const Projection original = project(path, settings);
      settings.sun = {0.0, 2.0, SunSettings::Action::replace};
      const Projection replaced = project(path, settings);
      ASSERT_TRUE(replaced.sun) << testing::PrintToString(replaced.warnings);
      const Sun& sun = *replaced.sun;
      EXPECT_EQ(sun.texel_count, sunny.sun_texels);
      const bool is_disc = layout == Layout::angular || layout == Layout::mirror_ball;
      if (!is_disc || d.x < 0.0) {
        EXPECT_LT(glm::length(sun.direction - direction), 0.5 * 2 * kPi / 96);
        EXPECT_NEAR(sun.angular_radius, kRadius, 0.5 * 2 * kPi / 96);
      }
      for (int c = 0; c < 3; ++c) {
        const double whole = original.radiance.channels[c][0];
        EXPECT_NEAR(replaced.radiance.channels[c][0], whole, 1e-13 * whole);
      }
    }
  }
}

// Two disks: the sun is the one that has the brightest texel, not both.
TEST_F(BrightLight, TheSunIsOneRegion) {
  Picture picture = make_picture(
      128, 64, [](int, int i, int j) { return i > 30 && i < 34 && j > 60 && j < 64 ? 50.0 : 1.0; });
  for (int c = 0; c < 3; ++c) picture.at(c, 32, 0) = picture.at(c, 31, 127) = 40.0F;
  const Projection one = project(write(picture, "two"), sun_of({0.0, 10.0}));
  ASSERT_TRUE(one.sun);
  EXPECT_EQ(one.sun->texel_count, 9);
  for (int c = 0; c < 3; ++c) picture.at(c, 32, 0) = 51.0F;
  const Projection other = project(write(picture, "two"), sun_of({0.0, 10.0}));
  ASSERT_TRUE(other.sun);
  EXPECT_EQ(other.sun->texel_count, 2) << "corners over the seam";
}

// residual + sun = original. The flux is sqrt(4 pi) L_00, changed in double by what each texel
// loses, so that only doubles round: 1e-13 of it. Reporting changes no bit.
TEST_F(BrightLight, TheLedgerOfEnergyBalances) {
  Picture picture = make_noisy_picture(256, 128, 4);
  for (int i = 40; i < 44; ++i) {
    for (int j = 50; j < 54; ++j) {
      for (int c = 0; c < 3; ++c) picture.at(c, i, j) = 3000.0F + 500.0F * (c + i) + j;
    }
  }
  const auto path = write(picture, "ledger");
  ProjectionSettings settings = sun_of({});
  const Projection original = project(path, settings);
  settings.sun = {0.001, 0.0, SunSettings::Action::keep};
  const Projection kept = project(path, settings);
  EXPECT_TRUE(kept.radiance == original.radiance);
  EXPECT_EQ(kept.pixels.mean, original.pixels.mean);
  settings.sun.action = SunSettings::Action::remove;
  const Projection removed = project(path, settings);
  ASSERT_TRUE(kept.sun && removed.sun);
  EXPECT_EQ(kept.sun->flux, removed.sun->flux);
  EXPECT_NEAR(kept.sun->share, removed.sun->share, 1e-13);
  settings.sun.action = SunSettings::Action::replace;
  const Projection replaced = project(path, settings);
  const double to_flux = std::sqrt(4.0 * kPi);
  for (int c = 0; c < 3; ++c) {
    const double whole = to_flux * original.radiance.channels[c][0];
    const double residual = to_flux * removed.radiance.channels[c][0];
    EXPECT_NEAR(residual + removed.sun->flux[c], whole, 1e-13 * whole);
    EXPECT_LT(residual, 0.9 * whole) << "there is a sun to take";
    // What the disk puts back is what was taken.
    EXPECT_NEAR(to_flux * replaced.radiance.channels[c][0], whole, 1e-13 * whole);
  }
  // At other degrees a disk differs from the region by their second moments, l(l+1)/2 times some
  // a^2 of the sun.
  const double radius = replaced.sun->angular_radius;
  EXPECT_LT(difference(replaced.radiance, original.radiance),
            8.0 * radius * radius * replaced.sun->flux.b);
}

// The sun is what it was before the clamp; what is clamped is what the sun left. So sun and clamp
// together balance as well.
TEST_F(BrightLight, TheLedgerBalancesWithAClampToo) {
  const auto path = write(make_noisy_picture(256, 128, 6), "both");
  const Projection original = project(path, sun_of({}));
  for (const bool late : {true, false}) {
    ProjectionSettings settings = sun_of({0.001, 0.0, SunSettings::Action::remove});
    if (late) settings.pixels.clamp_percentile = 99.0;
    if (!late) settings.pixels.clamp = 20.0;
    const Projection both = project(path, settings);
    ASSERT_TRUE(both.sun);
    EXPECT_GT(both.pixels.clamped_count, 100);
    for (int c = 0; c < 3; ++c) {
      const double whole = std::sqrt(4.0 * kPi) * original.radiance.channels[c][0];
      const double rest = std::sqrt(4.0 * kPi) * both.radiance.channels[c][0];
      // A clamp by value changes what the kernels see, which round by 1e-6.
      EXPECT_NEAR(rest + both.sun->flux[c] + both.pixels.clamped_flux[c], whole,
                  (late ? 1e-13 : 2e-6) * whole);
    }
    settings.sun.action = SunSettings::Action::keep;
    EXPECT_EQ(project(path, settings).sun->flux, both.sun->flux);
  }
}

TEST_F(BrightLight, SaysWhyThereIsNoSun) {
  const auto even = write(make_picture(64, 32, [](int, int, int) { return 3.0; }), "even");
  EXPECT_THAT(
      project(even, sun_of({0.001, 0.0})).warnings,
      testing::ElementsAre("no sun was found: its brightest light is evenly bright over a larger "
                           "region"));
  EXPECT_THAT(project(even, sun_of({0.0, 5.0})).warnings,
              testing::ElementsAre("no sun was found: nothing is brighter than 5"));
  EXPECT_THAT(
      project(even, sun_of({0.0, 2.0})).warnings,
      testing::ElementsAre("no sun was found: more than 1 % of the sphere is brighter than 2"));
  const auto black = write(make_picture(64, 32, [](int, int, int) { return 0.0; }), "black");
  EXPECT_THAT(project(black, clamp_at(99.9)).warnings,
              testing::ElementsAre("nothing was clamped: 99.9 % of the sphere are black"));
}

// What is not finite, or negative and to be black, is so for the sun and the clamp as well.
TEST_F(BrightLight, SeesPixelsAsThePolicyLeavesThem) {
  Picture picture = sunny(128, {0, 1, 0}, 0.1);
  picture.at(0, 10, 10) = INFINITY;
  picture.at(2, 64, 64) = NAN;
  picture.at(1, 64, 65) = -1e6F;
  ProjectionSettings settings = sun_of({0.005, 0.0, SunSettings::Action::remove});
  settings.pixels.nonfinite = PixelPolicy::NonFinite::zero;
  settings.pixels.negative = PixelPolicy::Negative::zero;
  const auto path = write(picture, "odd");
  const Projection removed = project(path, settings);
  ASSERT_TRUE(removed.sun);
  for (int c = 0; c < 3; ++c) {
    // All that is left is the sky, less than 1 for the black pixels.
    EXPECT_LT(removed.radiance.channels[c][0], std::sqrt(4.0 * kPi) * (1.0 + 1e-6));
  }
  EXPECT_EQ(removed.sun->texel_count, std::ranges::count(picture.planes[0], 1001.0F));
}

}  // namespace
}  // namespace shoal::test
