#include "batch/plan.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>

#include "batch/library_folder.h"
#include "batch/sqlite.h"

namespace shoal {
namespace {

namespace fs = std::filesystem;
using test::LibraryTest;

using Reasons = std::map<std::string, std::string>;

constexpr const char* kUpToDate = "up to date";
constexpr const char* kMaps = "maps: [{kind: irradiance, size: [8, 4], format: hdr}]\n";

class PlanTest : public LibraryTest {
 protected:
  // The reasons why a, b and c would run: of b as given, of the others none.
  static Reasons only_b(const std::string& reason) {
    return {{"a", kUpToDate}, {"b", reason}, {"c", kUpToDate}};
  }

  void touch_file(const std::string& name, int seconds) {
    const auto path = folder_ / name;
    fs::last_write_time(path, fs::last_write_time(path) + std::chrono::seconds(seconds));
  }
};

TEST_F(PlanTest, WithoutAStoreEverythingIsNew) {
  write_three();
  const Manifest manifest = manifest_of(library());
  const auto plan = make_plan(manifest, nullptr, {});
  ASSERT_TRUE(plan);
  ASSERT_EQ(plan->items.size(), 3u);
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_EQ(plan->items[i].entry, &manifest.entries[i]) << "manifest order";
    EXPECT_EQ(plan->items[i].reason, "new");
    EXPECT_EQ(plan->items[i].input_size, fs::file_size(manifest.entries[i].file));
  }
  EXPECT_EQ(plan->count(ItemWork::all), 3);
  EXPECT_FALSE(fs::exists(folder_ / "out")) << "a plan writes nothing";
}

TEST_F(PlanTest, AfterARunNothingIsToBeDone) {
  write_three();
  run(library(kMaps));
  const Ran ran = plan(library(kMaps));
  EXPECT_EQ(ran.reasons, only_b(kUpToDate));
  for (const auto& [name, work] : ran.work) EXPECT_EQ(work, ItemWork::none) << name;
}

TEST_F(PlanTest, AFileMoreIsNew) {
  write_three();
  run(library());
  write_panorama("lib/d.hdr", 4);
  Reasons expected = only_b(kUpToDate);
  expected["d"] = "new";
  EXPECT_EQ(plan(library()).reasons, expected);
}

TEST_F(PlanTest, ChangedContentRunsAgain) {
  write_three();
  run(library());
  write_panorama("lib/b.exr", 99, 40, 70);
  touch_file("lib/b.exr", 2);
  const Ran ran = plan(library());
  EXPECT_EQ(ran.reasons, only_b("its file's content changed"));
  EXPECT_EQ(ran.work.at("b"), ItemWork::all);
}

TEST_F(PlanTest, ATouchedFileIsUpToDateAndHashedOnceOnly) {
  write_three();
  run(library());
  touch_file("lib/b.exr", 2);
  const Manifest manifest = manifest_of(library());
  {
    Store store = open_store(manifest);
    const auto plan = make_plan(manifest, &store, {});
    ASSERT_TRUE(plan);
    EXPECT_EQ(plan->items[1].reason, kUpToDate);
    EXPECT_TRUE(plan->items[1].input_is_news);
    EXPECT_FALSE(plan->items[0].input_is_news);
  }
  run(library());
  Store store = open_store(manifest);
  const auto plan = make_plan(manifest, &store, {});
  EXPECT_FALSE(plan->items[1].input_is_news) << "the run remembers the new time";
}

// Same size and time, another content: only hashing can tell.
TEST_F(PlanTest, VerifyingInputsFindsWhatTimesHide) {
  write_three();
  run(library());
  const auto path = folder_ / "lib/b.exr";
  const auto time = fs::last_write_time(path);
  std::string content = test::content_of(path);
  content.back() = static_cast<char>(content.back() ^ 1);
  std::ofstream(path, std::ios::binary) << content;
  fs::last_write_time(path, time);
  EXPECT_EQ(plan(library()).reasons, only_b(kUpToDate));
  PlanOptions options;
  options.inputs = PlanOptions::Inputs::by_content;
  EXPECT_EQ(plan(library(), options).reasons, only_b("its file's content changed"));
}

TEST_F(PlanTest, ChangedParametersRunAgain) {
  write_three();
  run(library());
  const Ran ran = plan(library("defaults: {quadrature: fejer}\n"));
  for (const auto& [name, reason] : ran.reasons) {
    EXPECT_EQ(reason, "its parameters changed") << name;
    EXPECT_EQ(ran.work.at(name), ItemWork::all) << name;
  }
}

// Everything linear waits for the coefficients, so it never has a panorama decoded again.
TEST_F(PlanTest, LinearKeysAreNoReasonToProject) {
  write_three();
  run(library(kMaps));
  const Ran with_maps =
      plan(library(std::string(kMaps) + "variants: {soft: {exposure: -2, frame: openexr}}\n"));
  for (const auto& [name, work] : with_maps.work) EXPECT_EQ(work, ItemWork::outputs) << name;
  const Ran tables = plan(library(std::string(kMaps) + "quantities: [irradiance]\n"));
  for (const auto& [name, work] : tables.work) EXPECT_EQ(work, ItemWork::none) << name;
}

TEST_F(PlanTest, WhatFailedRunsAgain) {
  write_three();
  write("lib/b.exr", "no picture");
  run(library());
  const Ran ran = plan(library());
  EXPECT_EQ(ran.reasons, only_b("failed before"));
  EXPECT_EQ(ran.work.at("b"), ItemWork::all);
}

TEST_F(PlanTest, WhatWasInterruptedRunsAgain) {
  write_three();
  run(library());
  {
    Store store = open_store(manifest_of(library()));
    const std::string name = "b";
    ASSERT_TRUE(store.mark_stale(std::span(&name, 1)));
  }
  EXPECT_EQ(plan(library()).reasons, only_b("was interrupted"));
}

TEST_F(PlanTest, AnotherAlgorithmVersionRunsAgain) {
  write_three();
  run(library());
  {
    auto database = SqlDatabase::open(folder_ / "out/shoal.db", SqlDatabase::Create::never);
    ASSERT_TRUE(database);
    ASSERT_TRUE(database->execute("UPDATE items SET algorithm_version = 0 WHERE name = 'b'"));
  }
  EXPECT_EQ(plan(library()).reasons, only_b("shoal computes differently now"));
}

TEST_F(PlanTest, ForceRunsWhatIsUpToDate) {
  write_three();
  run(library());
  PlanOptions options;
  options.force = PlanOptions::Force::yes;
  for (const auto& [name, reason] : plan(library(), options).reasons) EXPECT_EQ(reason, "forced");
}

TEST_F(PlanTest, MissingOrResizedOutputsAreWrittenAnew) {
  write_three();
  run(library(kMaps));
  fs::remove(folder_ / "out/maps/b.irradiance.hdr");
  write("out/maps/c.irradiance.hdr", "short");
  const Ran ran = plan(library(kMaps));
  EXPECT_EQ(ran.work.at("a"), ItemWork::none);
  for (const char* name : {"b", "c"}) {
    EXPECT_EQ(ran.work.at(name), ItemWork::outputs);
    EXPECT_EQ(ran.reasons.at(name), "a file that it wrote is missing or has another size");
  }
}

TEST_F(PlanTest, MapsAskedForDifferentlyAreWrittenAnew) {
  write_three();
  run(library(kMaps));
  const Ran ran = plan(library("maps: [{kind: irradiance, size: [8, 4], format: png}]\n"));
  for (const auto& [name, work] : ran.work) {
    EXPECT_EQ(work, ItemWork::outputs) << name;
    EXPECT_EQ(ran.reasons.at(name), "its outputs are asked for differently") << name;
  }
}

TEST_F(PlanTest, AFileThatHasGoneSinceTheManifestWasReadIsToldByTheRun) {
  write_three();
  run(library());
  const Manifest manifest = manifest_of(library());
  fs::remove(folder_ / "lib/b.exr");
  Store store = open_store(manifest);
  const auto plan = make_plan(manifest, &store, {});
  ASSERT_TRUE(plan);
  EXPECT_EQ(plan->items[1].reason, "its file cannot be read");
  EXPECT_EQ(plan->items[1].work, ItemWork::all);
}

TEST_F(PlanTest, OnlySelectsByNameAndByTag) {
  write_three();
  const std::string text =
      "shoal: 1\noutput: out\npanoramas:\n"
      "  - {file: lib/a.hdr, name: day/noon, tags: [outdoor, sun]}\n"
      "  - {file: lib/b.exr, name: day/dusk, tags: [outdoor]}\n"
      "  - {file: lib/c.hdr, name: room}\n";
  const auto selected = [&](const std::string& only) {
    PlanOptions options;
    options.only = only;
    std::string names;
    for (const auto& [name, reason] : plan(text, options).reasons) names += name + " ";
    return names;
  };
  EXPECT_EQ(selected("room"), "room ");
  EXPECT_EQ(selected("day/*"), "day/dusk day/noon ");
  EXPECT_EQ(selected("outdoor"), "day/dusk day/noon ");
  EXPECT_EQ(selected("s?n"), "day/noon ");
  EXPECT_EQ(selected("{room,sun}"), "day/noon room ");
  EXPECT_EQ(selected("**"), "day/dusk day/noon room ");

  const Manifest manifest = manifest_of(text);
  PlanOptions options;
  options.only = "outdoor";
  const auto plan = make_plan(manifest, nullptr, options);
  EXPECT_EQ(plan->unselected_count, 1);
  for (const char* bad : {"nothing", "{a"}) {
    options.only = bad;
    const auto failed = make_plan(manifest, nullptr, options);
    ASSERT_FALSE(failed) << bad;
    EXPECT_EQ(failed.error().code, ErrorCode::usage) << bad;
  }
}

// A run from another folder finds what is up to date, though the manifest's paths are others then.
TEST_F(PlanTest, InputsAreKnownByTheirAbsolutePaths) {
  const auto stored = [](const char* file) {
    PanoramaEntry entry;
    entry.file = file;
    return stored_path(entry);
  };
  const std::string here = fs::current_path() / "";
  for (const char* a : {"a.hdr", "./a.hdr", "lib/../a.hdr", ".//a.hdr"}) {
    EXPECT_EQ(stored(a), here + "a.hdr") << a;
  }
  EXPECT_EQ(stored("lib/a.hdr"), here + "lib/a.hdr");
  EXPECT_EQ(stored("..a/.b..hdr"), here + "..a/.b..hdr");
  for (const char* a : {"/library/a.hdr", "/library/./a.hdr", "//library/b/..//a.hdr"}) {
    EXPECT_EQ(fs::path(stored(a)), "/library/a.hdr") << a;
  }
}

// The same panoramas in another folder are hashed once, to see that they are the same.
TEST_F(PlanTest, ALibraryThatMovedIsUpToDate) {
  write_three();
  run(library());
  fs::rename(folder_ / "lib", folder_ / "moved");
  const std::string moved = "shoal: 1\noutput: out\npanoramas: [{files: \"moved/*.{hdr,exr}\"}]\n";
  const auto news = [&] {
    const Manifest manifest = manifest_of(moved);
    Store store = open_store(manifest);
    const auto plan = make_plan(manifest, &store, {});
    EXPECT_EQ(plan->count(ItemWork::none), 3);
    return std::ranges::count_if(plan->items, [](const auto& item) { return item.input_is_news; });
  };
  EXPECT_EQ(news(), 3);
  run(moved);
  EXPECT_EQ(news(), 0);
}

}  // namespace
}  // namespace shoal
