// What a run makes of lights, rotations and windows, seen in its tables.
#include "batch/variant_light.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include "batch/library_folder.h"
#include "output/coefficient_table.h"
#include "sphere/basis.h"
#include "sphere/irradiance.h"
#include "sphere/least_irradiance.h"

namespace shoal {
namespace {

class VariantLightTest : public test::LibraryTest {
 protected:
  // The table's record of a panorama in a variant.
  CoefficientRecord record(const std::string& panorama, const std::string& variant) {
    auto records = read_csv_table(folder_ / "out/coefficients.csv");
    EXPECT_TRUE(records) << records.error().text();
    for (const CoefficientRecord& one : *records) {
      if (one.panorama == panorama && one.variant == variant) return one;
    }
    ADD_FAILURE() << panorama << " " << variant;
    return {};
  }
};

// A facing surface under one directional light of irradiance 1 gets sum_l (2l+1)/(4 pi) A_l
// = 1/4 + 1/2 + 5/16 = 17/16 from degree 2.
TEST_F(VariantLightTest, AFacingSurfaceGetsSeventeenSixteenths) {
  run("shoal: 1\noutput: out\nquantities: irradiance\ndefaults: {frame: three}\npanoramas: "
      "[{name: sun, lights: [{directional: {direction: [0, 3, 4], irradiance: [1, 2, 0]}}]}]\n");
  const Coefficients irradiance = record("sun", "plain").coefficients;
  // Of a sum of nine products: a few roundings.
  const glm::dvec3 facing = evaluate(irradiance, glm::dvec3(0, 0.6, 0.8));
  EXPECT_NEAR(facing.r, 17.0 / 16.0, 1e-15);
  EXPECT_NEAR(facing.g, 17.0 / 8.0, 2e-15);
  EXPECT_EQ(facing.b, 0.0);
}

// Projection is linear: the file's coefficients and the light's add up, and everything that follows
// acts on the sum. The light is told in the entry's frame.
TEST_F(VariantLightTest, LightsAreAddedToTheFile) {
  write_panorama("lib/a.hdr", 1);
  const std::string light = "lights: [{disk: {direction: [0, 1, 0], radius: 20, radiance: 3}}]";
  run("shoal: 1\noutput: out\nquantities: radiance\npanoramas:\n  - {file: lib/a.hdr, name: file}\n"
      "  - {file: lib/a.hdr, name: both, frame: openexr, " +
      light +
      "}\n"
      "  - {name: light, frame: openexr, " +
      light +
      "}\n"
      "variants: {plain: {frame: native}, dark: {frame: native, exposure: -1}}\n");
  const Coefficients file = record("file", "plain").coefficients;
  const Coefficients light_alone = record("light", "plain").coefficients;
  const Coefficients both = record("both", "plain").coefficients;
  const Coefficients dark = record("both", "dark").coefficients;
  for (int c = 0; c < kChannelCount; ++c) {
    for (std::size_t i = 0; i < both.channels[c].size(); ++i) {
      EXPECT_EQ(both.channels[c][i], file.channels[c][i] + light_alone.channels[c][i]);
      EXPECT_EQ(dark.channels[c][i], both.channels[c][i] / 2);
    }
  }
  // Up is +y of openexr and +z of the native frame.
  EXPECT_GT(light_alone.channels[0][coefficient_index(1, 0)], 0.0);
  EXPECT_EQ(light_alone.channels[0][coefficient_index(1, 1)], 0.0);
}

// Four quarter turns about the vertical bring every panorama back, and yaw is a phase: the second
// of two views has (L_11, L_1-1) negated.
TEST_F(VariantLightTest, ViewsTurnThePanorama) {
  write_panorama("lib/a.hdr", 1);
  run(
      library("quantities: radiance\nvariants: {plain: {}, back: {rotate: {yaw: 360}}, two: "
              "{views: 2}}\n"));
  const Coefficients plain = record("a", "plain").coefficients;
  EXPECT_EQ(record("a", "back").coefficients, plain);
  EXPECT_EQ(record("a", "two-1").coefficients, plain);
  const Coefficients turned = record("a", "two-2").coefficients;
  for (int c = 0; c < kChannelCount; ++c) {
    EXPECT_EQ(turned.channels[c][coefficient_index(1, 1)],
              -plain.channels[c][coefficient_index(1, 1)]);
    EXPECT_EQ(turned.channels[c][coefficient_index(1, -1)],
              -plain.channels[c][coefficient_index(1, -1)]);
    EXPECT_EQ(turned.channels[c][coefficient_index(1, 0)],
              plain.channels[c][coefficient_index(1, 0)]);
  }
}

// The tables of a variant are the same whether it is asked for alone or with others.
TEST_F(VariantLightTest, VariantsDoNotDisturbOneAnother) {
  write_panorama("lib/a.hdr", 1);
  const std::vector<std::pair<std::string, std::string>> variants = {
      {"soft", "{window: auto, rotate: {pitch: 30}, exposure: 0.7}"},
      {"rest", "{dominant: remove, mirror: left-right}"},
      {"set", "{views: {count: 3, over: all}, window: auto}"}};
  const auto rows_of = [&](const std::string& name) {  // of the table of quality
    std::ifstream table(folder_ / "out/quality.csv");
    std::vector<std::string> rows;
    for (std::string row; std::getline(table, row);) {
      if (row.find("," + name) != std::string::npos) rows.push_back(row);
    }
    return rows;
  };
  const std::string tables = "tables: [csv, quality]\n";
  std::vector<CoefficientRecord> alone;
  std::vector<std::vector<std::string>> figures;
  std::string all = "variants: {plain: {}, other: {window: hann}";
  for (const auto& [name, keys] : variants) {
    run(library(tables + "variants: {" + name + ": " + keys + "}\n"));
    alone.push_back(record("a", name == "set" ? "set-2" : name));
    figures.push_back(rows_of(name));
    all += ", " + name + ": " + keys;
  }
  run(library(tables + all + "}\n"));
  for (std::size_t i = 0; i < variants.size(); ++i) {
    const std::string& name = variants[i].first;
    EXPECT_EQ(record("a", name == "set" ? "set-2" : name), alone[i]) << name;
    EXPECT_FALSE(figures[i].empty());
    EXPECT_EQ(rows_of(name), figures[i]) << name;
  }
}

// The mirror image of f is f(x, -y, z), so L_lm of sin(|m| phi), which is odd in y, is negated. The
// lights beside a file are where the manifest says.
TEST_F(VariantLightTest, AMirroredPictureIsTheOtherWayRound) {
  write_panorama("lib/a.hdr", 1);
  const std::string lamp =
      "defaults: {lights: [{directional: {direction: [0.3, 0.5, 1], irradiance: 2}}]}\n";
  const std::string variants = "variants: {plain: {}, mirrored: {mirror: left-right}}\n";
  run(library("quantities: radiance\n" + variants));
  const Coefficients plain = record("a", "plain").coefficients;
  const Coefficients mirrored = record("a", "mirrored").coefficients;
  run(library("quantities: radiance\n" + lamp + variants));
  const Coefficients lit = record("a", "plain").coefficients;
  const Coefficients mirrored_lit = record("a", "mirrored").coefficients;
  for (int c = 0; c < kChannelCount; ++c) {
    for (int l = 0; l <= plain.degree; ++l) {
      for (int m = -l; m <= l; ++m) {
        const int i = coefficient_index(l, m);
        const double value = plain.channels[c][i];
        EXPECT_EQ(mirrored.channels[c][i], m < 0 ? -value : value) << l << ' ' << m;
        EXPECT_NEAR(mirrored_lit.channels[c][i] - mirrored.channels[c][i],
                    lit.channels[c][i] - value, 1e-12);
      }
    }
  }
}

// An automatic window leaves no direction of a sun's irradiance negative; without one the least is
// -0.039583, 122.2 degrees away.
TEST_F(VariantLightTest, AutomaticWindowsLeaveNothingNegative) {
  run("shoal: 1\noutput: out\nquantities: irradiance\npanoramas: [{name: sun, lights: "
      "[{directional: {direction: [0, 0, 1], irradiance: 1}}]}]\nvariants: {plain: {}, soft: "
      "{window: auto}}\n");
  const auto at = [&](const std::string& variant) {
    const double angle = 122.2 * std::numbers::pi / 180.0;
    return evaluate(record("sun", variant).coefficients,
                    glm::dvec3(std::sin(angle), 0, std::cos(angle)))
        .r;
  };
  EXPECT_NEAR(at("plain"), -0.039583, 1e-6);
  EXPECT_GT(at("soft"), -1e-9);
}

// The irradiance of a turned light takes the same values, elsewhere, so all turns of one light
// share one window, to the bit; another light has its own.
TEST_F(VariantLightTest, TurnsShareTheirAutomaticWindow) {
  write_panorama("lib/a.hdr", 1);
  const Manifest manifest = manifest_of(library(
      "defaults: {lights: [{directional: {direction: [0, 3, 4], irradiance: 9}}]}\nvariants: "
      "{turned: {window: auto, rotate: {pitch: 30}}, plain: {window: auto}, other: "
      "{window: auto, matrix: [[0, 1, 0], [1, 0, 0], [0.9, 0, 0.1]]}}\n"));
  const PanoramaEntry& entry = manifest.entries.front();
  ProjectionTables tables;
  const auto projection = project_panorama(entry.file, {}, entry.settings->projection, tables);
  ASSERT_TRUE(projection.ok());
  VariantLights lights(*projection, entry);
  const auto turned = lights.in(manifest.variants[0]);
  const auto plain = lights.in(manifest.variants[1]);
  const auto other = lights.in(manifest.variants[2]);
  ASSERT_TRUE(turned && plain && other);
  EXPECT_LT(*std::ranges::min_element(plain->gains), 1.0) << "nothing is cut";
  EXPECT_EQ(turned->gains, plain->gains);
  EXPECT_NE(other->gains, plain->gains);
  EXPECT_EQ(VariantLights(*projection, entry).in(manifest.variants[0])->radiance, turned->radiance)
      << "alone or with others";
  for (const auto& light : {turned, plain, other}) {
    EXPECT_GE(least_irradiance(light->radiance)->value, -1e-11);
  }
}

// Lights alone are processed once, like files; what changes them makes them run again.
TEST_F(VariantLightTest, LightsAloneAreUpToDate) {
  const auto manifest = [](const std::string& radiance) {
    return "shoal: 1\noutput: out\npanoramas: [{name: a, lights: [{ambient: {radiance: " +
           radiance + "}}]}]\nmaps: [{kind: irradiance, size: [8, 4]}]\n";
  };
  EXPECT_EQ(run(manifest("1")).summary.done_count, 1);
  const Ran again = run(manifest("1"));
  EXPECT_EQ(again.summary.done_count, 0);
  EXPECT_EQ(again.reasons.at("a"), "up to date");
  const Ran changed = run(manifest("2"));
  EXPECT_EQ(changed.reasons.at("a"), "its parameters changed");
  EXPECT_NEAR(record("a", "plain").coefficients.channels[0][0],
              2.0 * std::sqrt(4.0 * std::numbers::pi), 1e-14);
}

}  // namespace
}  // namespace shoal
