#include "batch/store.h"

#include <gtest/gtest.h>

#include <chrono>
#include <cmath>
#include <map>
#include <thread>

#include "batch/store_support.h"
#include "support/temporary_folder.h"

namespace shoal {
namespace {

using test::expect_same_bits;
using test::problems_of;
using test::some_item;
using test::some_projection;
using test::TemporaryFolder;

TEST(Store, GivesBackEverythingThatWasRecorded) {
  const TemporaryFolder folder;
  const auto path = folder / "out/deep/shoal.db";
  const Projection projection = some_projection(1, 64);
  const ItemRecord item = some_item("stu\"dio/nor'th \xff\xc3\xbc\n", &projection);
  ItemRecord failed = some_item("broken", nullptr);
  failed.state.status = ItemStatus::failed;
  failed.state.error = "row 17 ends after 203 of 1024 pixels";
  failed.state.outputs.clear();
  const InputState input{std::uint64_t{1} << 35, -1234567890123456789, "content"};
  {
    auto store = Store::open(path, Store::Access::write);
    ASSERT_TRUE(store.ok()) << store.error().text();
    ASSERT_TRUE(store->record(item).ok());
    ASSERT_TRUE(store->record(failed).ok());
    ASSERT_TRUE(store->record_input("/library/a.exr", input).ok());
  }
  for (const auto access : {Store::Access::write, Store::Access::read}) {
    auto store = Store::open(path, access);
    ASSERT_TRUE(store.ok()) << store.error().text();
    const auto items = store->items();
    ASSERT_TRUE(items.ok()) << items.error().text();
    EXPECT_EQ(*items, (std::unordered_map<std::string, ItemState>{{item.name, item.state},
                                                                  {"broken", failed.state}}));
    EXPECT_EQ(store->items()->at(item.name), item.state);
    EXPECT_EQ(*store->find_input("/library/a.exr"), input);
    EXPECT_EQ(*store->find_input("nowhere"), std::nullopt);

    const auto found = store->find_projection(item.name);
    ASSERT_TRUE(found.ok()) << found.error().text();
    const Projection& back = found->value();
    expect_same_bits(back.radiance, projection.radiance);
    EXPECT_EQ(back.grid, projection.grid);
    EXPECT_EQ(back.format, projection.format);
    EXPECT_EQ(back.quadrature, projection.quadrature);
    EXPECT_EQ(back.solid_angle, projection.solid_angle);
    EXPECT_EQ(back.pixels.minimum, projection.pixels.minimum);
    EXPECT_EQ(back.pixels.maximum, projection.pixels.maximum);
    EXPECT_EQ(back.pixels.mean, projection.pixels.mean);
    EXPECT_EQ(back.pixels.clamped_flux, projection.pixels.clamped_flux);
    EXPECT_EQ(back.pixels.pixel_count, projection.pixels.pixel_count);
    EXPECT_EQ(back.pixels.nonfinite_count, projection.pixels.nonfinite_count);
    EXPECT_EQ(back.pixels.negative_count, projection.pixels.negative_count);
    EXPECT_EQ(back.pixels.clamped_count, projection.pixels.clamped_count);
    EXPECT_EQ(back.pixels.clamp_threshold, projection.pixels.clamp_threshold);
    EXPECT_EQ(back.pixels.clamp_colour_shift, projection.pixels.clamp_colour_shift);
    EXPECT_EQ(back.sun, projection.sun);
    EXPECT_EQ(back.warnings, projection.warnings);
    EXPECT_FALSE(store->find_projection("broken")->has_value());
  }
  EXPECT_EQ(problems_of(path), "");
}

// A pass hands over what items() collects, with ids by which projections are found, and with what
// is known of the items' files.
TEST(Store, APassOverTheItemsTellsAllOfThem) {
  const TemporaryFolder folder;
  auto store = Store::open(folder / "s.db", Store::Access::write);
  const std::map<std::string, Projection> projections = {{"a", some_projection(1, 2)},
                                                         {"b", some_projection(2, 3)}};
  for (const auto& [name, projection] : projections) {
    ItemRecord item = some_item(name, &projection);
    if (name == "b") item.input = InputState{7, 8, "content of b"};
    ASSERT_TRUE(store->record(item).ok());
  }
  std::map<std::string, std::int64_t> ids;
  ASSERT_TRUE(store->for_each_item([&](const ItemRow& row) {
    ids[std::string(row.name)] = row.id;
    EXPECT_EQ(row.parameters, "degree: 2");
    EXPECT_EQ(row.input.has_value(), row.name == "b");
    EXPECT_EQ(row.input ? row.input->content_hash : "", row.input ? "content of b" : "");
  }));
  std::map<std::int64_t, int> output_counts;
  ASSERT_TRUE(
      store->for_each_output([&](std::int64_t id, const OutputRecord&) { ++output_counts[id]; }));
  EXPECT_EQ(output_counts, (std::map<std::int64_t, int>{{ids["a"], 2}, {ids["b"], 2}}));
  ASSERT_TRUE(store->read_in_one([&]() -> Status {
    for (const auto& [name, projection] : projections) {
      SHOAL_ASSIGN_OR_RETURN(found, store->find_projection(ids[name]));
      EXPECT_EQ(found->radiance, projection.radiance) << name;
    }
    return {};
  }));
  EXPECT_FALSE(store->find_projection(ids["b"] + 1)->has_value());
  const Status failed = store->read_in_one([]() -> Status {
    return Error{ErrorCode::usage, "as asked", "", ""};
  });
  EXPECT_EQ(failed.error().what, "as asked");
  EXPECT_TRUE(store->record_input("/library/a.exr", {1, 2, "later"})) << "no lock is left behind";
  EXPECT_EQ(store->find_input("/library/b.exr")->value().size, 7u);
}

// A picture without a single finite sample has no extremes.
TEST(Store, KeepsInfinitiesAndNaNsOfThePixelReport) {
  const TemporaryFolder folder;
  Projection projection = some_projection(1, 0);
  projection.pixels.minimum = {INFINITY, NAN, -INFINITY};
  auto store = Store::open(folder / "s.db", Store::Access::write);
  ASSERT_TRUE(store->record(some_item("a", &projection)).ok());
  const auto minimum = store->find_projection("a")->value().pixels.minimum;
  EXPECT_EQ(minimum[0], INFINITY);
  EXPECT_TRUE(std::isnan(minimum[1]));
  EXPECT_EQ(minimum[2], -INFINITY);
}

TEST(Store, RecordingAgainTakesThePlaceOfWhatWasThere) {
  const TemporaryFolder folder;
  auto store = Store::open(folder / "s.db", Store::Access::write);
  const Projection first = some_projection(1, 2);
  const Projection second = some_projection(2, 5);
  ASSERT_TRUE(store->record(some_item("a", &first)).ok());
  ASSERT_TRUE(store->record(some_item("b", &first)).ok());
  ItemRecord again = some_item("a", &second);
  again.state.outputs = {{"maps/a.new.exr", "map:irradiance", "new", 1}};
  again.state.parameters = "other parameters";
  ASSERT_TRUE(store->record(again).ok());
  EXPECT_EQ(store->items()->at("a"), again.state);
  EXPECT_EQ(store->find_projection("a")->value().radiance, second.radiance);
  EXPECT_EQ(store->items()->at("b"), some_item("b", &first).state);

  ItemRecord failed = some_item("a", nullptr);
  failed.state.status = ItemStatus::failed;
  failed.state.outputs.clear();
  ASSERT_TRUE(store->record(failed).ok());
  EXPECT_EQ(store->items()->at("a"), failed.state);
  EXPECT_FALSE(store->find_projection("a")->has_value());
  EXPECT_TRUE(store->find_projection("b")->has_value());
}

TEST(Store, MarkStaleIsCommittedAtOnceAndTouchesOnlyWhatItNames) {
  const TemporaryFolder folder;
  const Projection projection = some_projection(1, 2);
  auto store = Store::open(folder / "s.db", Store::Access::write);
  for (const auto* name : {"a", "b", "c"}) {
    ASSERT_TRUE(store->record(some_item(name, &projection)).ok());
  }
  const std::vector<std::string> names = {"a", "c", "not yet recorded"};
  ASSERT_TRUE(store->mark_stale(names).ok());
  auto other = Store::open(folder / "s.db", Store::Access::read);
  const auto items = *other->items();
  ASSERT_EQ(items.size(), 3u);
  EXPECT_EQ(items.at("a").status, ItemStatus::stale);
  EXPECT_EQ(items.at("b").status, ItemStatus::done);
  EXPECT_EQ(items.at("c").status, ItemStatus::stale);
}

TEST(Store, WritesAreSeenByOthersAfterFlush) {
  const TemporaryFolder folder;
  const Projection projection = some_projection(1, 2);
  auto store = Store::open(folder / "s.db", Store::Access::write);
  auto other = Store::open(folder / "s.db", Store::Access::read);
  ASSERT_TRUE(store->record(some_item("a", &projection)).ok());
  EXPECT_TRUE(other->items()->empty());
  ASSERT_TRUE(store->flush().ok());
  EXPECT_EQ(other->items()->size(), 1u);
}

// The delay before finished work is safe is bounded without anybody calling flush().
TEST(Store, AWriteASecondAfterTheLastCommitCommits) {
  const TemporaryFolder folder;
  const Projection projection = some_projection(1, 2);
  auto store = Store::open(folder / "s.db", Store::Access::write);
  auto other = Store::open(folder / "s.db", Store::Access::read);
  std::this_thread::sleep_for(std::chrono::milliseconds(1050));
  ASSERT_TRUE(store->record(some_item("a", &projection)).ok());
  EXPECT_EQ(other->items()->size(), 1u);
}

TEST(Store, RunOutputsAndPropertiesAreReplaced) {
  const TemporaryFolder folder;
  const Projection projection = some_projection(1, 2);
  auto store = Store::open(folder / "s.db", Store::Access::write);
  const std::vector<OutputRecord> tables = {{"coefficients.csv", "table:csv", "h1", 10},
                                            {"coefficients.npy", "table:npy", "h2", 20}};
  ASSERT_TRUE(store->record(some_item("a", &projection)).ok());
  ASSERT_TRUE(store->set_run_outputs(tables).ok());
  EXPECT_EQ(*store->run_outputs(), tables);
  ASSERT_TRUE(store->set_run_outputs({}).ok());
  EXPECT_TRUE(store->run_outputs()->empty());
  EXPECT_EQ(store->items()->at("a").outputs.size(), 2u);

  EXPECT_EQ(*store->property("tables"), "");
  ASSERT_TRUE(store->set_property("tables", "x").ok());
  ASSERT_TRUE(store->set_property("tables", "y").ok());
  EXPECT_EQ(*store->property("tables"), "y");
}

TEST(Store, GlobsAreThoseOfTheLastRun) {
  const TemporaryFolder folder;
  auto store = Store::open(folder / "s.db", Store::Access::write);
  std::vector<GlobExpansion> globs = {
      {"*.hdr", {"b.hdr", "a.hdr"}}, {"*.exr", {}}, {"*.hdr", {"c.hdr"}}};
  ASSERT_TRUE(store->set_globs(globs).ok());
  EXPECT_EQ(*store->globs(), globs);
  globs.pop_back();
  globs[1].files = {"new.exr"};
  ASSERT_TRUE(store->set_globs(globs).ok());
  EXPECT_EQ(*store->globs(), globs);
  ASSERT_TRUE(store->set_globs({}).ok());
  EXPECT_TRUE(store->globs()->empty());
  EXPECT_EQ(problems_of(folder / "s.db"), "");
}

TEST(Store, TagsAreThoseOfTheLastRun) {
  const TemporaryFolder folder;
  auto store = Store::open(folder / "s.db", Store::Access::write);
  const std::vector<std::string> two = {"sun, noon", "out"};
  const std::vector<std::string> one = {"in"};
  // A panorama that is given a tag twice keeps both.
  const std::vector<std::string> same = {"x", "x"};
  const std::vector<PanoramaTags> before = {{"a", two}, {"b", {}}, {"c", same}};
  ASSERT_TRUE(store->set_tags(before).ok());
  ASSERT_TRUE(store->set_tags(before).ok());
  EXPECT_EQ(*store->tags_of("a"), two);
  EXPECT_TRUE(store->tags_of("b")->empty());
  EXPECT_EQ(*store->tags_of("c"), same);
  ASSERT_TRUE(store->set_tags(std::vector<PanoramaTags>{{"b", one}}).ok());
  EXPECT_TRUE(store->tags_of("a")->empty());
  EXPECT_EQ(*store->tags_of("b"), one);
  EXPECT_EQ(problems_of(folder / "s.db"), "");
}

TEST(Store, VariantsAreThoseOfTheLastRun) {
  const TemporaryFolder folder;
  auto store = Store::open(folder / "s.db", Store::Access::write);
  // Numbers without a short decimal form, each once: rows and columns must not change places.
  const std::vector<VariantFacts> two = {
      {"a", "x", *parse_frame("+z,-x,+y"), glm::dmat3(1, 2, 3, 4, 5, 6, 7, 8, 1.0 / 9), {}, false},
      {"b", "x", {}, glm::dmat3(1.0), glm::dmat3(0.1, 0, 0, 0, 0, -1.0 / 3, 0, 1e-300, 0), true}};
  ASSERT_TRUE(store->set_variants(two).ok());
  EXPECT_EQ(*store->variants(), two);
  ASSERT_TRUE(store->set_variants({}).ok());
  EXPECT_TRUE(store->variants()->empty());
}

}  // namespace
}  // namespace shoal
