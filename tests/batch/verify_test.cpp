#include "batch/verify.h"

#include <gtest/gtest.h>

#include <bit>

#include "batch/library_folder.h"
#include "batch/sqlite.h"

namespace shoal {
namespace {

namespace fs = std::filesystem;
using test::LibraryTest;
using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

class VerifyTest : public LibraryTest {
 protected:
  void SetUp() override {
    write_three();
    run(library(kMaps));
  }

  VerifyReport verify(VerifyOptions::Recompute recompute = VerifyOptions::Recompute::no) {
    const std::atomic<bool> stop{false};
    auto report = verify_outputs(folder_ / "out", {recompute, 2}, stop);
    EXPECT_TRUE(report) << report.error().text();
    return report ? std::move(*report) : VerifyReport{};
  }

  // Another byte in the middle, the same size.
  void flip_byte(const std::string& name) {
    std::string content = test::content_of(folder_ / name);
    content[content.size() / 2] = static_cast<char>(content[content.size() / 2] ^ 1);
    write(name, content);
  }

  void change_store(const char* sql) {
    auto database = SqlDatabase::open(folder_ / "out/shoal.db", SqlDatabase::Create::never);
    ASSERT_TRUE(database);
    ASSERT_TRUE(database->execute(sql));
  }

  static constexpr const char* kMaps = "maps: [{kind: irradiance, size: [8, 4], format: hdr}]\n";
  static constexpr auto kRecompute = VerifyOptions::Recompute::yes;
};

TEST_F(VerifyTest, AfterARunAllIsWell) {
  VerifyReport report = verify();
  EXPECT_THAT(report.problems, IsEmpty());
  EXPECT_EQ(report.panorama_count, 3);
  EXPECT_EQ(report.output_count, 4) << "three maps, one table";
  EXPECT_EQ(report.recomputed_count, 0);
  report = verify(kRecompute);
  EXPECT_THAT(report.problems, IsEmpty());
  EXPECT_EQ(report.recomputed_count, 3);
}

TEST_F(VerifyTest, FindsAChangedMapOfTheSameSize) {
  flip_byte("out/maps/b.irradiance.hdr");
  EXPECT_THAT(verify().problems,
              ElementsAre(AllOf(HasSubstr("b.irradiance.hdr"), HasSubstr("not what the run"))));
}

TEST_F(VerifyTest, FindsAChangedTable) {
  flip_byte("out/coefficients.csv");
  EXPECT_THAT(verify().problems, ElementsAre(HasSubstr("coefficients.csv")));
}

TEST_F(VerifyTest, FindsMissingFiles) {
  fs::remove(folder_ / "out/maps/c.irradiance.hdr");
  fs::remove(folder_ / "lib/a.hdr");
  EXPECT_THAT(verify().problems, ElementsAre(HasSubstr("lib/a.hdr"), HasSubstr("c.irradiance")));
}

TEST_F(VerifyTest, FindsAChangedInput) {
  flip_byte("lib/b.exr");
  EXPECT_THAT(verify().problems, ElementsAre(AllOf(HasSubstr("lib/b.exr"), HasSubstr("changed"))));
}

TEST_F(VerifyTest, TellsOfWhatFailedAndOfWhatWasInterrupted) {
  write("lib/b.exr", "no picture");
  run(library(kMaps));
  change_store("UPDATE items SET status = 'stale' WHERE name = 'c'");
  EXPECT_THAT(verify().problems,
              ElementsAre(AllOf(HasSubstr("b"), HasSubstr("failed")), HasSubstr("interrupted")));
}

// The lowest bit of one coefficient.
TEST_F(VerifyTest, RecomputingFindsASingleBit) {
  {
    Store store = open_store(manifest_of(library(kMaps)));
    auto projection = store.find_projection("b");
    ASSERT_TRUE(projection);
    double& value = (*projection)->radiance.channels[1][4];
    value = std::bit_cast<double>(std::bit_cast<std::uint64_t>(value) ^ 1);
    ItemRecord item;
    item.name = "b";
    item.state = store.items()->at("b");
    item.projection = &**projection;
    ASSERT_TRUE(store.record(item));
  }
  EXPECT_THAT(verify().problems, IsEmpty());
  EXPECT_THAT(verify(kRecompute).problems, ElementsAre(HasSubstr("b: projects to other")));
}

TEST_F(VerifyTest, RecomputingGoesByTheParametersOfTheRun) {
  const std::string text =
      library("defaults: {degree: 4, quadrature: fejer, rgbe_decode: center, clamp: 5}\n");
  run(text);
  const VerifyReport report = verify(kRecompute);
  EXPECT_THAT(report.problems, IsEmpty());
  EXPECT_EQ(report.recomputed_count, 3);
}

TEST_F(VerifyTest, AFolderWithoutAStoreIsAnError) {
  const std::atomic<bool> stop{false};
  const auto report = verify_outputs(folder_ / "lib", {}, stop);
  ASSERT_FALSE(report);
  EXPECT_EQ(report.error().code, ErrorCode::not_found);
  EXPECT_FALSE(fs::exists(folder_ / "lib/shoal.db")) << "looking makes nothing";
}

// A panorama that the manifest no longer names is no concern of its store. What a run does not
// select is still named, and stays.
TEST_F(VerifyTest, WhatTheManifestNoLongerNamesIsForgotten) {
  fs::remove(folder_ / "lib/c.hdr");
  EXPECT_THAT(verify().problems, ElementsAre(HasSubstr("c.hdr")));
  RunOptions only_a;
  only_a.plan.only = "a";
  run(library(), only_a);
  const VerifyReport report = verify();
  EXPECT_THAT(report.problems, IsEmpty());
  EXPECT_EQ(report.panorama_count, 2);
}

TEST_F(VerifyTest, StoppedItSaysSo) {
  const std::atomic<bool> stop{true};
  const auto report = verify_outputs(folder_ / "out", {}, stop);
  ASSERT_FALSE(report);
  EXPECT_EQ(report.error().code, ErrorCode::interrupted);
}

}  // namespace
}  // namespace shoal
