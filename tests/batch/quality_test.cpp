// Figures of quality on their way through a run: settings, store, table.
#include <gmock/gmock.h>

#include <sstream>

#include "batch/fingerprint.h"
#include "batch/library_folder.h"
#include "batch/store_support.h"
#include "batch/variant_light.h"
#include "batch/verify.h"
#include "output/quality_table.h"
#include "sphere/linear_operations.h"

namespace shoal {
namespace {

using test::LibraryTest;
using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::SizeIs;

constexpr const char* kQuality =
    "defaults: {quality: 12}\n"
    "variants: {plain: {}, soft: {window: hann, exposure: -1}}\n"
    "tables: [csv, quality]\n";

class QualityRun : public LibraryTest {
 protected:
  using Row = std::map<std::string, std::string>;

  // The rows of quality.csv by their columns' names. No name in these tests needs quotes.
  std::vector<Row> rows() {
    std::istringstream text(table("quality.csv"));
    std::string line;
    std::getline(text, line);
    EXPECT_EQ(line + "\n", quality_csv_header(VariantColumn::present));
    const std::vector<std::string> names = fields(line);
    std::vector<Row> rows;
    while (std::getline(text, line)) {
      const std::vector<std::string> values = fields(line);
      EXPECT_EQ(values.size(), names.size()) << line;
      rows.emplace_back();
      for (std::size_t i = 0; i < values.size(); ++i) rows.back()[names[i]] = values[i];
    }
    return rows;
  }

  static std::vector<std::string> fields(const std::string& line) {
    std::vector<std::string> parts(1);
    for (const char c : line) {
      if (c == ',') {
        parts.emplace_back();
      } else {
        parts.back() += c;
      }
    }
    return parts;
  }

  static std::string library_of_lights() {
    return "shoal: 1\noutput: out\ntables: [quality]\n"
           "defaults: {quality: 40, frame: {center: +z, right: -x, up: +y}}\n"
           "panoramas: [{name: key, lights: [{directional: {direction: [0, 1, 0], irradiance: "
           "[3, 3, 3]}}]}]\n";
  }

  std::vector<VariantQuality> stored(const Manifest& manifest, const std::string& name) {
    Store store = open_store(manifest);
    std::int64_t id = 0;
    EXPECT_TRUE(store.for_each_item([&](const ItemRow& row) {
      if (row.name == name) id = row.id;
    }));
    auto found = store.find_quality(id);
    EXPECT_TRUE(found) << found.error().text();
    return std::move(*found);
  }
};

TEST_F(QualityRun, WritesARowAPanoramaAndVariant) {
  write_three();
  const Ran ran = run(library(kQuality));
  EXPECT_THAT(ran.summary.tables, SizeIs(2));
  const std::vector<Row> table_rows = rows();
  std::vector<std::string> names;
  for (const Row& row : table_rows) names.push_back(row.at("panorama") + " " + row.at("variant"));
  EXPECT_THAT(names, ElementsAre("a plain", "a soft", "b plain", "b soft", "c plain", "c soft"));
  for (const Row& row : table_rows) {
    EXPECT_EQ(row.at("degree"), "2");
    EXPECT_EQ(row.at("error_degree"), "12");
    const double rms = std::stod(row.at("rms_error"));
    EXPECT_GT(rms, 0.001);
    EXPECT_GT(std::stod(row.at("max_error")), rms);
    EXPECT_EQ(row.at("nonfinite_pixels"), "0");
  }
  const Row& plain = table_rows[0];
  const Row& soft = table_rows[1];
  EXPECT_EQ(plain.at("window_gains"), "1 1 1");
  EXPECT_THAT(soft.at("window_gains"), HasSubstr("1 0.7"));  // (1 + cos(pi/3))/2 = 0.75
  EXPECT_GT(std::stod(soft.at("rms_error")), std::stod(plain.at("rms_error")));
  EXPECT_NEAR(std::stod(soft.at("mean_g")), std::stod(plain.at("mean_g")) / 2, 1e-12);
  EXPECT_EQ(soft.at("energy_shares"), plain.at("energy_shares")) << "halving is exact";
}

// The coefficients do not know that figures are asked for.
TEST_F(QualityRun, ChangesNoBitOfTheCoefficients) {
  write_three();
  run(library("variants: {plain: {}, soft: {window: hann, exposure: -1}}\n"));
  const std::string without = table();
  remove_outputs();
  run(library(kQuality));
  EXPECT_EQ(table(), without);
}

TEST_F(QualityRun, TheSameBytesForEveryThreadCountAndWithTheStoreOrWithout) {
  write_three();
  for (int i = 0; i < 5; ++i) write_panorama("lib/more" + std::to_string(i) + ".hdr", 10 + i);
  RunOptions options;
  options.threads = 1;
  run(library(kQuality), options);
  const std::string expected = table("quality.csv");
  for (const int threads : {2, 5}) {
    remove_outputs();
    options.threads = threads;
    run(library(kQuality), options);
    EXPECT_EQ(table("quality.csv"), expected) << threads << " threads";
  }
  // A second run takes all from the store.
  std::filesystem::remove(folder_ / "out/quality.csv");
  EXPECT_EQ(run(library(kQuality)).summary.done_count, 0);
  EXPECT_EQ(table("quality.csv"), expected);
}

TEST_F(QualityRun, LeavesErrorsEmptyWhereNothingIsKnownAboveTheDegree) {
  write_three();
  run(library("tables: quality\n"));
  EXPECT_FALSE(std::filesystem::exists(folder_ / "out/coefficients.csv"));
  ASSERT_THAT(rows(), SizeIs(3));
  for (const Row& row : rows()) {
    EXPECT_EQ(row.at("error_degree") + row.at("rms_error") + row.at("max_error"), "");
    EXPECT_NE(row.at("contrast"), "");
    EXPECT_EQ(row.at("variant"), "plain");
  }
}

// Only what is linear changes: nothing is decoded again, and what is not asked for any more goes.
TEST_F(QualityRun, IsMadeAnewWithTheOutputs) {
  write_three();
  run(library(kQuality));
  const std::string before = table("quality.csv");
  const std::string other =
      "defaults: {quality: 12}\nvariants: {plain: {}}\ntables: [csv, quality]\n";
  const Ran ran = run(library(other));
  for (const auto& [name, work] : ran.work) EXPECT_EQ(work, ItemWork::outputs) << name;
  EXPECT_THAT(stored(manifest_of(library(other)), "a"), SizeIs(1));
  EXPECT_EQ(ran.summary.pixel_count, 0);
  EXPECT_THAT(rows(), SizeIs(3));
  run(library(kQuality));
  EXPECT_EQ(table("quality.csv"), before);
}

// A run over some panoramas with other variants leaves the others' figures in the store behind.
TEST_F(QualityRun, TellsTheVariantsOfTheManifestThoughARunLeftSomeAlone) {
  write_three();
  const std::string changed =
      "defaults: {quality: 12}\nvariants: {plain: {exposure: 1}, soft: {window: hann}}\n"
      "tables: [csv, quality]\n";
  run(library(changed));
  const std::string expected = table("quality.csv");
  remove_outputs();
  run(library(kQuality));
  RunOptions options;
  options.plan.only = "a";
  EXPECT_EQ(run(library(changed), options).summary.done_count, 1);
  EXPECT_EQ(table("quality.csv"), expected);
}

TEST_F(QualityRun, StandsInTheStoreWholly) {
  write_three();
  const std::string text = library(kQuality);
  run(text);
  const Manifest manifest = manifest_of(text);
  ProjectionTables tables;
  for (const PanoramaEntry& entry : manifest.entries) {
    const auto projection = project_panorama(entry.file, {}, entry.settings->projection, tables);
    ASSERT_TRUE(projection && projection->finer);
    const std::vector<VariantQuality> found = stored(manifest, entry.name);
    ASSERT_THAT(found, SizeIs(2));
    VariantLights lights(*projection, entry);
    for (std::size_t i = 0; i < found.size(); ++i) {
      const Variant& variant = manifest.variants[i];
      const auto expected = lights.quality(variant, *lights.in(variant));
      EXPECT_EQ(found[i].variant, variant.name);
      EXPECT_TRUE(found[i].quality == *expected) << "every bit of every figure";
    }
    Store store = open_store(manifest);
    EXPECT_EQ((*store.find_projection(entry.name))->finer, projection->finer);
  }
}

// Every figure that there may not be is NULL in the store, and nothing when it comes back.
TEST_F(QualityRun, EmptyFiguresComeBackEmpty) {
  const Manifest manifest = manifest_of(library_of_lights());
  Store store = open_store(manifest);
  const Projection projection = test::some_projection(1, 2);
  ItemRecord item = test::some_item("dark", &projection);
  item.quality = {{"plain", light_quality(Coefficients(2), {1, 1, 1}, Coefficients(2))}};
  item.quality[0].quality.least.reset();
  ASSERT_TRUE(store.record(item));
  std::int64_t id = 0;
  ASSERT_TRUE(store.for_each_item([&](const ItemRow& row) { id = row.id; }));
  EXPECT_EQ(*store.find_quality(id), item.quality);
  item.state.status = ItemStatus::failed;
  item.quality.clear();
  item.projection = nullptr;
  ASSERT_TRUE(store.record(item));
  EXPECT_THAT(*store.find_quality(id), IsEmpty());
}

TEST_F(QualityRun, LightsAloneAreKnownToTheHigherDegreeToo) {
  run(library_of_lights());
  ASSERT_THAT(rows(), SizeIs(1));
  const Row row = rows()[0];
  EXPECT_EQ(row.at("error_degree"), "40");
  // 8.839 % of a lone light, less what is above degree 40: 1.5e-4 of it.
  EXPECT_NEAR(std::stod(row.at("rms_error")), 0.088388, 0.088388 * 4e-4);
  // In the manifest's frame, where it was given.
  EXPECT_NEAR(std::stod(row.at("dominant_y")), 1.0, 1e-12);
  EXPECT_NEAR(std::stod(row.at("dominant_r")), 3.0, 1e-12);
  EXPECT_NEAR(std::stod(row.at("minimum_irradiance")), -4 * 0.0395833, 1e-6);
}

TEST_F(QualityRun, VerifiesTheHigherDegreeToo) {
  write_three();
  run(library(kQuality));
  const std::atomic<bool> stop{false};
  const auto verify = [&] {
    return *verify_outputs(folder_ / "out", {VerifyOptions::Recompute::yes, 2}, stop);
  };
  EXPECT_THAT(verify().problems, IsEmpty());
  auto database = SqlDatabase::open(folder_ / "out/shoal.db", SqlDatabase::Create::never);
  ASSERT_TRUE(database->execute(
      "UPDATE projections SET finer = zeroblob(length(finer)) WHERE item = (SELECT min(id) FROM "
      "items)"));
  EXPECT_THAT(verify().problems, ElementsAre(HasSubstr("projects to other coefficients")));
}

// What the store says of parameters reads back, and a degree that changes nothing is not in it.
TEST_F(QualityRun, IsAParameterWhereItIsHigher) {
  EntrySettings settings;
  const std::string without = parameter_text(settings);
  settings.projection.quality_degree = 2;
  EXPECT_EQ(parameter_text(settings), without);
  settings.projection.quality_degree = 20;
  EXPECT_THAT(parameter_text(settings), HasSubstr("quality: 20"));
  const auto read = parse_parameters(parameter_text(settings));
  ASSERT_TRUE(read);
  EXPECT_EQ(read->projection.quality_degree, 20);
}

TEST_F(QualityRun, RefusesDegreesThatThereAreNot) {
  write_three();
  EXPECT_THAT(load(library("defaults: {quality: 65}\n")).messages, HasSubstr("quality"));
  EXPECT_THAT(load(library("tables: [qualities]\n")).messages, HasSubstr("quality"));
  EXPECT_THAT(load(library("tables: [quality, quality]\n")).messages, HasSubstr("twice"));
}

}  // namespace
}  // namespace shoal
