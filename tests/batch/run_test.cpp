#include "batch/run.h"

#include <gtest/gtest.h>

#include <chrono>
#include <string_view>

#include "batch/library_folder.h"
#include "output/coefficient_table.h"

namespace shoal {
namespace {

namespace fs = std::filesystem;
using test::LibraryTest;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::SizeIs;

constexpr const char* kEverything =
    "variants: {plain: {}, dark: {exposure: -3}}\n"
    "tables: [csv, json, npy]\n"
    "maps:\n"
    "  - {kind: irradiance, size: [8, 4], format: exr}\n"
    "  - {kind: radiance, layout: cube, size: 4, faces: files, format: hdr}\n";

class RunTest : public LibraryTest {
 protected:
  std::vector<CoefficientRecord> records() {
    auto records = read_csv_table(folder_ / "out/coefficients.csv");
    EXPECT_TRUE(records) << records.error().text();
    return records ? std::move(*records) : std::vector<CoefficientRecord>{};
  }
};

TEST_F(RunTest, WritesWhatTheManifestAsksFor) {
  write_three();
  const Ran ran = run(library(kEverything));
  EXPECT_EQ(ran.summary.done_count, 3);
  EXPECT_EQ(ran.summary.pixel_count, 24 * 12 + 40 * 70 + 24 * 12);
  EXPECT_EQ(ran.summary.map_count, 3 * 2 * (1 + 6));
  EXPECT_EQ(ran.summary.missing_count, 0);
  EXPECT_THAT(ran.summary.tables, SizeIs(3));
  EXPECT_THAT(ran.summary.failures, IsEmpty());
  EXPECT_FALSE(ran.summary.interrupted);
  const auto files = outputs();
  EXPECT_THAT(files, SizeIs(4 + 3 * 2 * 7)) << "npy has its names beside it";
  for (const char* name :
       {"coefficients.csv", "coefficients.json", "coefficients.npy", "coefficients.names.csv",
        "maps/a.dark.irradiance.exr", "maps/b.plain.radiance.cube.px.hdr"}) {
    EXPECT_TRUE(files.contains(name)) << name;
  }
}

TEST_F(RunTest, TheSameBytesForEveryThreadCount) {
  write_three();
  for (int i = 0; i < 9; ++i) write_panorama("lib/more" + std::to_string(i) + ".hdr", 10 + i);
  RunOptions options;
  options.threads = 1;
  run(library(kEverything), options);
  const auto expected = outputs();
  for (const int threads : {2, 7}) {
    remove_outputs();
    options.threads = threads;
    run(library(kEverything), options);
    EXPECT_TRUE(outputs() == expected) << threads << " threads";
  }
}

TEST_F(RunTest, ASecondRunDoesAndWritesNothing) {
  write_three();
  run(library(kEverything));
  const auto expected = outputs();
  const auto time = fs::last_write_time(folder_ / "out/coefficients.csv");
  const Ran ran = run(library(kEverything));
  EXPECT_EQ(ran.summary.done_count, 0);
  EXPECT_EQ(ran.summary.up_to_date_count, 3);
  EXPECT_EQ(ran.summary.map_count, 0);
  EXPECT_TRUE(outputs() == expected);
  EXPECT_EQ(fs::last_write_time(folder_ / "out/coefficients.csv"), time);
}

TEST_F(RunTest, ForcedItWritesTheSameBytes) {
  write_three();
  run(library(kEverything));
  const auto expected = outputs();
  RunOptions options;
  options.plan.force = PlanOptions::Force::yes;
  EXPECT_EQ(run(library(kEverything), options).summary.done_count, 3);
  EXPECT_TRUE(outputs() == expected);
}

TEST_F(RunTest, AddingAPanoramaIsLikeARunFromNothing) {
  write_three();
  run(library(kEverything));
  write_panorama("lib/aa.hdr", 17);
  EXPECT_EQ(run(library(kEverything)).summary.done_count, 1);
  const auto incremental = outputs();
  EXPECT_TRUE(fresh_outputs(library(kEverything)) == incremental);
}

TEST_F(RunTest, ChangingAPanoramaIsLikeARunFromNothing) {
  write_three();
  run(library(kEverything));
  const std::string before = table();
  write_panorama("lib/b.exr", 18, 30, 20);
  const Ran ran = run(library(kEverything));
  EXPECT_EQ(ran.summary.done_count, 1);
  EXPECT_EQ(ran.summary.pixel_count, 600);
  const auto incremental = outputs();
  EXPECT_NE(table(), before);
  EXPECT_TRUE(fresh_outputs(library(kEverything)) == incremental);
}

TEST_F(RunTest, RemovingAPanoramaTakesItOutOfTheTables) {
  write_three();
  run(library());
  fs::remove(folder_ / "lib/b.exr");
  EXPECT_EQ(run(library()).summary.done_count, 0);
  const std::string incremental = table();
  fresh_outputs(library());
  EXPECT_EQ(table(), incremental);
}

TEST_F(RunTest, ChangingParametersIsLikeARunFromNothing) {
  write_three();
  run(library(kEverything));
  const std::string changed = library(std::string(kEverything) + "defaults: {degree: 5}\n");
  EXPECT_EQ(run(changed).summary.done_count, 3);
  const auto incremental = outputs();
  EXPECT_TRUE(fresh_outputs(changed) == incremental);
}

// pixel_count counts what was decoded: everything linear is made from the store.
TEST_F(RunTest, ChangingMapsDecodesNothing) {
  write_three();
  run(library(kEverything));
  const std::string changed = library(
      "variants: {plain: {}, dark: {exposure: -2, white: [1, 2, 3]}}\n"
      "tables: [csv, json, npy]\n"
      "maps:\n"
      "  - {kind: irradiance, size: [8, 4], format: exr}\n"
      "  - {kind: radiance, layout: cube, size: 4, faces: files, format: hdr}\n");
  const Ran ran = run(changed);
  EXPECT_EQ(ran.summary.done_count, 3);
  EXPECT_EQ(ran.summary.pixel_count, 0);
  EXPECT_EQ(ran.summary.byte_count, 0u);
  EXPECT_EQ(ran.summary.map_count, 3 * 2 * 7);
  const auto incremental = outputs();
  EXPECT_TRUE(fresh_outputs(changed) == incremental);
}

// The name of the only variant stands in the maps' attributes, not in the files' names.
TEST_F(RunTest, RenamingTheOnlyVariantIsLikeARunFromNothing) {
  write_three();
  const std::string maps = "maps: [{kind: irradiance, size: [8, 4], format: exr}]\n";
  run(library(maps + "variants: {first: {}}\n"));
  run(library(maps + "variants: {second: {}}\n"));
  const auto incremental = outputs();
  EXPECT_TRUE(fresh_outputs(library(maps + "variants: {second: {}}\n")) == incremental);
}

TEST_F(RunTest, ChangingTablesDecodesAndWritesNothingElse) {
  write_three();
  run(library());
  const std::string changed = library("quantities: [irradiance_over_pi]\ntables: [json, csv]\n");
  const Ran ran = run(changed);
  EXPECT_EQ(ran.summary.done_count, 0);
  EXPECT_EQ(ran.summary.up_to_date_count, 3);
  const auto incremental = outputs();
  EXPECT_TRUE(incremental.contains("coefficients.json"));
  EXPECT_TRUE(fresh_outputs(changed) == incremental);
}

TEST_F(RunTest, ALostTableIsWrittenAgain) {
  write_three();
  run(library());
  const std::string expected = table();
  fs::remove(folder_ / "out/coefficients.csv");
  EXPECT_EQ(run(library()).summary.done_count, 0);
  EXPECT_EQ(table(), expected);
}

TEST_F(RunTest, AskedForAnotherTableWhenAllHaveFailedItIsWritten) {
  write("lib/a.hdr", "no picture");
  run(library());
  run(library("tables: [csv, json]\n"));
  EXPECT_TRUE(fs::exists(folder_ / "out/coefficients.json"));
}

TEST_F(RunTest, AFailureLeavesTheOthers) {
  write_three();
  fresh_outputs(library(kEverything));
  fs::remove(folder_ / "lib/b.exr");
  const auto without_b = fresh_outputs(library(kEverything));

  write("lib/b.exr", "no picture");
  for (const int threads : {1, 7}) {
    remove_outputs();
    RunOptions options;
    options.threads = threads;
    const Ran ran = run(library(kEverything), options);
    EXPECT_EQ(ran.summary.done_count, 2);
    EXPECT_EQ(ran.summary.missing_count, 1);
    ASSERT_THAT(ran.summary.failures, SizeIs(1));
    EXPECT_EQ(ran.summary.failures[0].panorama, "b");
    EXPECT_THAT(ran.summary.failures[0].text, HasSubstr("lib/b.exr"));
    EXPECT_FALSE(ran.summary.interrupted);
    EXPECT_TRUE(outputs() == without_b);
  }
}

TEST_F(RunTest, OnlyWhatFailedRunsAgainAndThenAllIsAsFromNothing) {
  write_three();
  const std::string good = test::content_of(folder_ / "lib/b.exr");
  const auto expected = fresh_outputs(library());
  write("lib/b.exr", "no picture");
  remove_outputs();
  run(library());
  Ran ran = run(library());
  EXPECT_EQ(ran.summary.up_to_date_count, 2);
  EXPECT_THAT(ran.summary.failures, SizeIs(1)) << "told again, not forgotten";
  write("lib/b.exr", good);
  ran = run(library());
  EXPECT_EQ(ran.summary.done_count, 1);
  EXPECT_TRUE(outputs() == expected);
}

TEST_F(RunTest, FailuresAndWarningsComeInManifestOrder) {
  for (const char* name : {"lib/a.hdr", "lib/c.hdr", "lib/e.hdr"}) write(name, "no picture");
  write_panorama("lib/b.hdr", 1);
  write_panorama("lib/d.hdr", 2);
  RunOptions options;
  options.threads = 7;
  const Ran ran = run(library(), options);
  std::vector<std::string> names;
  for (const auto& note : ran.summary.failures) names.push_back(note.panorama);
  EXPECT_THAT(names, ElementsAre("a", "c", "e"));
}

TEST_F(RunTest, FailFastStopsAndKeepsWhatIsFinished) {
  write("lib/a.hdr", "no picture");
  for (int i = 0; i < 20; ++i) write_panorama("lib/b" + std::to_string(i) + ".hdr", 10 + i);
  RunOptions options;
  options.threads = 1;
  options.on_failure = RunSettings::OnFailure::stop;
  const Ran ran = run(library(), options);
  EXPECT_THAT(ran.summary.failures, SizeIs(1));
  EXPECT_EQ(ran.summary.done_count, 0);
  EXPECT_FALSE(ran.summary.interrupted) << "it failed; nobody interrupted it";
}

TEST_F(RunTest, AnInterruptedRunSaysSoAlsoWhenSomethingFailedBefore) {
  write_panorama("lib/a.hdr", 1);
  write("lib/b.hdr", "no picture");
  write_panorama("lib/c.hdr", 2);
  const Manifest manifest = manifest_of(library());
  {
    Store store = open_store(manifest);
    const auto plan = make_plan(manifest, &store, {});
    ASSERT_TRUE(plan);
    std::atomic<bool> stop{false};
    const auto stop_at_failure = [&stop](std::string_view event) {
      if (event.find(R"("status": "failed")") != event.npos) stop = true;
    };
    Progress progress(ProgressMode::json, Terminal{}, stop_at_failure,
                      std::chrono::steady_clock::now);
    const auto summary = run_plan(manifest, *plan, store, {}, progress, stop);
    ASSERT_TRUE(summary) << summary.error().text();
    EXPECT_TRUE(summary->interrupted);
    EXPECT_EQ(summary->done_count, 1);
    EXPECT_THAT(summary->failures, SizeIs(1));
  }
  EXPECT_EQ(run(library()).summary.up_to_date_count, 1) << "what was finished is kept";
}

// Rows of one variant do not depend on which others there are.
TEST_F(RunTest, AVariantIsTheSameAloneAndWithOthers) {
  write_three();
  const std::string dark = "dark: {exposure: -2.5, matrix: [[0, 1, 0], [0, 0, 1], [1, 0, 0]]}";
  run(library("variants: {" + dark + "}\n"));
  const auto alone = records();
  run(library("variants: {plain: {}, " + dark + ", grey: {scale: 0.5}}\n"));
  std::vector<CoefficientRecord> of_dark;
  for (const auto& record : records()) {
    if (record.variant == "dark") of_dark.push_back(record);
  }
  EXPECT_THAT(of_dark, SizeIs(3 * 2));
  EXPECT_EQ(of_dark, alone);
}

// 2^-3 and 4 are powers of two, so the products are exact.
TEST_F(RunTest, ExposureAndScaleMultiplyExactly) {
  write_three();
  run(
      library("variants: {plain: {}, dark: {exposure: -3}, bright: {scale: 4}}\n"
              "quantities: [radiance]\n"));
  const auto all = records();
  ASSERT_THAT(all, SizeIs(9));
  for (std::size_t i = 0; i < all.size(); i += 3) {
    for (int c = 0; c < kChannelCount; ++c) {
      for (std::size_t k = 0; k < 9; ++k) {
        const double plain = all[i].coefficients.channels[c][k];
        EXPECT_EQ(all[i + 1].coefficients.channels[c][k], plain / 8.0);
        EXPECT_EQ(all[i + 2].coefficients.channels[c][k], plain * 4.0);
      }
    }
  }
}

TEST_F(RunTest, QuantitiesComeInTheirOrderAndAreOneAnother) {
  write_three();
  run(library("quantities: [irradiance_over_pi, radiance, irradiance]\n"));
  const auto all = records();
  ASSERT_THAT(all, SizeIs(9));
  for (std::size_t i = 0; i < all.size(); i += 3) {
    EXPECT_EQ(all[i].quantity, Quantity::irradiance_over_pi);
    EXPECT_EQ(all[i + 1].quantity, Quantity::radiance);
    EXPECT_EQ(all[i + 2].quantity, Quantity::irradiance);
    const Coefficients& radiance = all[i + 1].coefficients;
    EXPECT_EQ(all[i].coefficients, apply_quantity(radiance, Quantity::irradiance_over_pi));
    EXPECT_EQ(all[i + 2].coefficients, apply_quantity(radiance, Quantity::irradiance));
  }
}

// An axis frame is a signed permutation of degree 1: y, z, x are the indices 1, 2, 3.
TEST_F(RunTest, FramesOfVariantsTurnTheCoefficients) {
  write_three();
  run(
      library("variants: {native: {}, turned: {frame: {center: +z, right: -x, up: +y}}}\n"
              "quantities: [radiance]\n"));
  const auto all = records();
  ASSERT_THAT(all, SizeIs(6));
  for (std::size_t i = 0; i < all.size(); i += 2) {
    for (int c = 0; c < kChannelCount; ++c) {
      const auto& native = all[i].coefficients.channels[c];
      const auto& turned = all[i + 1].coefficients.channels[c];
      EXPECT_EQ(turned[0], native[0]);
      // The centre, native -x, is +z; the right, native -y, is -x; up, native +z, is +y.
      EXPECT_EQ(turned[2], -native[3]);
      EXPECT_EQ(turned[3], native[1]);
      EXPECT_EQ(turned[1], native[2]);
    }
  }
}

TEST_F(RunTest, OnlyRunsWhatIsSelectedAndKeepsTheRestInTheTables) {
  write_three();
  const auto expected = fresh_outputs(library());
  remove_outputs();
  RunOptions options;
  options.plan.only = "[ab]";
  Ran ran = run(library(), options);
  EXPECT_EQ(ran.summary.done_count, 2);
  EXPECT_EQ(ran.summary.missing_count, 1);
  options.plan.only = "c";
  ran = run(library(), options);
  EXPECT_EQ(ran.summary.done_count, 1);
  EXPECT_EQ(ran.summary.missing_count, 0);
  EXPECT_TRUE(outputs() == expected);
}

// The coefficients of one content must never be remembered as those of another.
TEST_F(RunTest, AFileThatChangedAfterThePlanIsProjectedAsItIsNow) {
  write_three();
  run(library());
  write_panorama("lib/b.exr", 50, 40, 70);
  const Manifest manifest = manifest_of(library());
  {
    Store store = open_store(manifest);
    const auto plan = make_plan(manifest, &store, {});
    ASSERT_TRUE(plan);
    write_panorama("lib/b.exr", 51, 44, 22);
    Progress progress(ProgressMode::none);
    std::atomic<bool> stop{false};
    ASSERT_TRUE(run_plan(manifest, *plan, store, {}, progress, stop));
  }
  EXPECT_EQ(run(library()).summary.up_to_date_count, 3);
  const std::string incremental = table();
  fresh_outputs(library());
  EXPECT_EQ(table(), incremental);
}

TEST_F(RunTest, TheStoreTellsWhatTheGlobsNamed) {
  write_three();
  run(library());
  const Manifest manifest = manifest_of(library());
  const auto globs = open_store(manifest).globs();
  ASSERT_TRUE(globs);
  ASSERT_THAT(*globs, SizeIs(1));
  std::vector<std::string> expected;
  for (const char* name : {"lib/a.hdr", "lib/b.exr", "lib/c.hdr"}) {
    expected.push_back((folder_ / name).string());
  }
  EXPECT_EQ(globs->front().files, expected);
}

}  // namespace
}  // namespace shoal
