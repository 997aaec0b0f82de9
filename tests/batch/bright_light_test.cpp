// Suns, clamps by percentile and dominant lights in manifests, in the store and in the tables.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <map>
#include <sstream>

#include "batch/library_folder.h"
#include "batch/variant_light.h"
#include "batch/verify.h"
#include "output/coefficient_table.h"
#include "sphere/dominant_light.h"

namespace shoal {
namespace {

using ::testing::HasSubstr;

class BrightLightTest : public test::LibraryTest {
 protected:
  std::map<std::string, Coefficients> radiance_by_variant(const std::string& panorama) {
    auto records = read_csv_table(folder_ / "out/coefficients.csv");
    EXPECT_TRUE(records) << records.error().text();
    std::map<std::string, Coefficients> found;
    for (const CoefficientRecord& record : *records) {
      if (record.panorama == panorama) found[record.variant] = record.coefficients;
    }
    return found;
  }

  // The rows of lights.csv by panorama, each a number by column; what is empty is left out.
  std::map<std::string, std::map<std::string, double>> lights() {
    std::istringstream stream(table("lights.csv"));
    std::string line;
    std::getline(stream, line);
    const auto split = [](const std::string& text) {
      std::vector<std::string> cells(1);
      for (const char letter : text) {
        if (letter == ',')
          cells.emplace_back();
        else
          cells.back() += letter;
      }
      return cells;
    };
    const std::vector<std::string> columns = split(line);
    std::map<std::string, std::map<std::string, double>> rows;
    while (std::getline(stream, line)) {
      const std::vector<std::string> cells = split(line);
      EXPECT_EQ(cells.size(), columns.size()) << line;
      for (std::size_t i = 1; i < cells.size(); ++i) {
        if (!cells[i].empty()) rows[cells[0]][columns[i]] = std::stod(cells[i]);
      }
      rows[cells[0]];
    }
    return rows;
  }

  Projection stored(const std::string& text, const std::string& name) {
    const Manifest manifest = manifest_of(text);
    Store store = open_store(manifest);
    auto projection = store.find_projection(name);
    EXPECT_TRUE(projection && *projection);
    return projection && *projection ? std::move(**projection) : Projection{};
  }
};

TEST_F(BrightLightTest, ReadsItsKeys) {
  touch({"a.hdr"});
  const Manifest manifest = manifest_of(
      "shoal: 1\ndefaults: {clamp: {percentile: 99.5}, sun: {top: 0.002, action: remove}}\n"
      "panoramas:\n  - {file: a.hdr, name: defaults}\n  - {file: a.hdr, name: other, clamp: 7, "
      "sun: {above: 50}}\n  - {file: a.hdr, name: none, sun: none, clamp: 0, dominant: only}\n"
      "tables: lights\n");
  ASSERT_EQ(manifest.entries.size(), 3U);
  const auto settings = [&](int i) { return manifest.entries[i].settings->projection; };
  EXPECT_EQ(settings(0).pixels.clamp_percentile, 99.5);
  EXPECT_EQ(settings(0).sun, (SunSettings{0.002, 0.0, SunSettings::Action::remove}));
  EXPECT_EQ(settings(1).pixels.clamp, 7.0);
  EXPECT_EQ(settings(1).pixels.clamp_percentile, 0.0);
  EXPECT_EQ(settings(1).sun, (SunSettings{0.0, 50.0, SunSettings::Action::keep}));
  EXPECT_EQ(settings(2).sun, SunSettings{});
  EXPECT_EQ(settings(2).pixels.clamp_percentile, 0.0);
  EXPECT_EQ(dominant_of(*manifest.entries[2].settings, {}), DominantPart::only);
  EXPECT_EQ(manifest.figure_tables, std::vector{FigureTable::lights});
}

TEST_F(BrightLightTest, TellsWhatIsWrong) {
  touch({"a.hdr"});
  const auto told = [&](const std::string& keys) {
    return messages("shoal: 1\npanoramas: [{file: a.hdr, " + keys + "}]\n");
  };
  EXPECT_THAT(told("clamp: {percentile: 50}"), HasSubstr("a number from 99 to below 100"));
  EXPECT_THAT(told("clamp: {percentile: 100}"), HasSubstr("a number from 99 to below 100"));
  EXPECT_THAT(told("clamp: {}"), HasSubstr("a clamp needs a percentile"));
  EXPECT_THAT(told("clamp: -1"), HasSubstr("not negative"));
  EXPECT_THAT(told("sun: {top: 0.02}"), HasSubstr("at most 0.01"));
  EXPECT_THAT(told("sun: {top: 0.001, above: 5}"), HasSubstr("either by top or by above"));
  EXPECT_THAT(told("sun: {action: remove}"), HasSubstr("either by top or by above"));
  EXPECT_THAT(told("sun: {top: 0.001, action: hide}"), HasSubstr("keep, remove"));
  EXPECT_THAT(told("sun: bright"), HasSubstr("none"));
  EXPECT_THAT(told("dominant: all"), HasSubstr("keep, remove"));
}

// The light and the rest: each coefficient is their sum, exactly where the light's is not the
// larger one, and else to a unit in the light's last place (sphere/dominant_light.h).
TEST_F(BrightLightTest, TheDominantLightAndTheRestAreTheWhole) {
  write_panorama("lib/a.hdr", 1, 64, 32);
  run(library(
      "quantities: radiance\ndefaults: {degree: 5, quality: 9, rotate: {yaw: 20, pitch: 30}, "
      "exposure: 0.3}\nvariants: {all: {}, light: {dominant: only}, rest: {dominant: remove}, "
      "given: {dominant: keep}}\n"));
  auto found = radiance_by_variant("a");
  EXPECT_EQ(found["given"], found["all"]);
  const auto expected = dominant_light(found["all"]);
  ASSERT_TRUE(expected);
  EXPECT_EQ(found["light"], expected->projected);
  EXPECT_EQ(found["rest"], expected->residual);
  for (int c = 0; c < kChannelCount; ++c) {
    for (int i = 0; i < coefficient_count(5); ++i) {
      const double whole = found["all"].channels[c][i];
      const double light = found["light"].channels[c][i];
      const double sum = light + found["rest"].channels[c][i];
      const double unit = std::nextafter(std::abs(light), INFINITY) - std::abs(light);
      EXPECT_NEAR(sum, whole, std::abs(light) <= std::abs(whole) ? 0.0 : unit) << i;
    }
  }
}

TEST_F(BrightLightTest, ALightThatIsEvenHasNoDominantPart) {
  run("shoal: 1\noutput: out\nquantities: radiance\npanoramas: [{name: fog, lights: [{ambient: "
      "{radiance: 2}}]}]\nvariants: {all: {}, light: {dominant: only}, rest: {dominant: remove}}\n"
      "tables: [csv, lights]\n");
  auto found = radiance_by_variant("fog");
  EXPECT_EQ(found["rest"], found["all"]);
  EXPECT_EQ(found["light"], Coefficients(2));
  EXPECT_TRUE(lights()["fog"].empty());
}

// A light of one direction is its own dominant light: its irradiance is 4, its directionality 1,
// all of its energy. Exposure and rotation act on it as on the panorama; directions are in the
// entry's frame.
TEST_F(BrightLightTest, TheTableOfLightsTellsTheDominantLight) {
  run("shoal: 1\noutput: out\npanoramas:\n  - {name: lamp, frame: three, exposure: 1, lights: "
      "[{directional: {direction: [0, 3, 4], irradiance: [1, 2, 0]}}]}\ntables: lights\n");
  auto row = lights()["lamp"];
  const std::map<std::string, double> expected = {
      {"dominant_x", 0.0}, {"dominant_y", 0.6}, {"dominant_z", 0.8},     {"dominant_r", 2.0},
      {"dominant_g", 4.0}, {"dominant_b", 0.0}, {"directionality", 1.0}, {"dominant_energy", 1.0}};
  EXPECT_EQ(row.size(), expected.size()) << "and no sun";
  for (const auto& [column, value] : expected) EXPECT_NEAR(row[column], value, 1e-14) << column;
}

constexpr const char* kSuns =
    "shoal: 1\noutput: out\nquantities: radiance\ntables: [csv, lights]\n"
    "panoramas:\n"
    "  - {file: a.exr, name: plain}\n"
    "  - {file: a.exr, name: keep, sun: {above: 90000}}\n"
    "  - {file: a.exr, name: remove, sun: {above: 90000, action: remove}}\n"
    "  - {file: a.exr, name: replace, sun: {above: 90000, action: replace}}\n"
    "  - {file: a.exr, name: dimmed, sun: {above: 90000}, exposure: -1, frame: openexr, rotate: "
    "{yaw: 90}}\n"
    "  - {file: a.exr, name: clamped, clamp: {percentile: 99}}\n";

// The made panorama has a sun of 10^5 in a texel. What the store and the table tell of it is what
// the coefficients lose with it.
TEST_F(BrightLightTest, ARunFindsSunsAndStoresThem) {
  write_panorama("a.exr", 3, 64, 32);
  run(kSuns);
  auto rows = lights();
  ASSERT_EQ(rows.size(), 6U);
  EXPECT_FALSE(rows["plain"].contains("sun_x"));
  EXPECT_EQ(rows["keep"]["sun_texels"], 1.0);
  EXPECT_EQ(rows["keep"]["sun_level"], 90000.0);
  EXPECT_EQ(rows["keep"]["sun_g"], rows["replace"]["sun_g"]);
  // Exposure by -1 halves, yaw turns to the right by 90 degrees: openexr's +z to its -x, its x to
  // z.
  EXPECT_EQ(rows["dimmed"]["sun_g"], rows["keep"]["sun_g"] / 2);
  EXPECT_EQ(rows["dimmed"]["sun_share"], rows["keep"]["sun_share"]);
  EXPECT_NEAR(rows["dimmed"]["sun_y"], rows["keep"]["sun_z"], 1e-15) << "up";

  const Coefficients plain = radiance_by_variant("plain")["plain"];
  const Coefficients removed = radiance_by_variant("remove")["plain"];
  EXPECT_EQ(radiance_by_variant("keep")["plain"], plain);
  const Projection projection = stored(kSuns, "remove");
  ASSERT_TRUE(projection.sun);
  for (int c = 0; c < kChannelCount; ++c) {
    const double taken = plain.channels[c][0] - removed.channels[c][0];
    EXPECT_NEAR(taken * std::sqrt(4 * std::numbers::pi), projection.sun->flux[c],
                1e-12 * plain.channels[c][0]);
  }
  EXPECT_EQ(projection.sun->irradiance.g, rows["keep"]["sun_g"]);
  const Projection clamped = stored(kSuns, "clamped");
  EXPECT_FALSE(clamped.sun);
  EXPECT_GT(clamped.pixels.clamp_threshold, 1.0);
  EXPECT_LT(clamped.pixels.clamp_threshold, 1e5);
  EXPECT_GT(clamped.pixels.clamp_colour_shift, 0.0);

  VerifyOptions options;
  options.recompute = VerifyOptions::Recompute::yes;
  const std::atomic<bool> stop{false};
  const auto report = verify_outputs(folder_ / "out", options, stop);
  ASSERT_TRUE(report) << report.error().text();
  EXPECT_EQ(report->recomputed_count, 6);
  EXPECT_THAT(report->problems, testing::IsEmpty()) << "the parameters in the store say all";
}

// lights.csv is a function of the manifest and the files: no thread, no earlier run shows in it.
TEST_F(BrightLightTest, TheSameBytesForEveryThreadCountAndHistory) {
  write_panorama("a.exr", 3, 64, 32);
  const auto expected = fresh_outputs(kSuns);
  RunOptions options;
  options.threads = 5;
  remove_outputs();
  run(kSuns, options);
  EXPECT_TRUE(outputs() == expected);
  EXPECT_EQ(run(std::string(kSuns)).summary.done_count, 0);
  // Only what is linear changes: nothing is projected anew, and the table is that of a fresh run.
  std::string brighter = kSuns;
  brighter.replace(brighter.find("exposure: -1"), 12, "exposure: 2");
  EXPECT_EQ(run(brighter).summary.pixel_count, 0);
  const auto after = outputs();
  EXPECT_TRUE(after == fresh_outputs(brighter));
  EXPECT_FALSE(after == expected);
}

TEST_F(BrightLightTest, EveryKeyChangesWhatIsUpToDate) {
  write_panorama("a.exr", 3, 64, 32);
  const auto of = [](const std::string& keys) {
    return "shoal: 1\noutput: out\npanoramas: [{file: a.exr, name: a, " + keys + "}]\n";
  };
  for (const char* keys : {"tags: a", "sun: {top: 0.001}", "sun: {top: 0.002}", "sun: {above: 10}",
                           "sun: {above: 10, action: remove}", "sun: {above: 10, action: replace}",
                           "clamp: {percentile: 99}", "clamp: {percentile: 99.5}"}) {
    EXPECT_EQ(run(of(keys)).summary.done_count, 1) << keys;
    EXPECT_EQ(run(of(keys)).summary.done_count, 0) << keys;
  }
}

}  // namespace
}  // namespace shoal
