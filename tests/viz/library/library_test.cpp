#include "library/library.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "library/table_library.h"
#include "made_library.h"
#include "output/coefficient_table.h"
#include "sphere/rotation.h"
#include "sphere/turns.h"

namespace shoal::viz {
namespace {

using test::LibraryTest;
using testing::ElementsAre;
using testing::HasSubstr;

std::vector<std::string> names_of(const Library& library) {
  std::vector<std::string> names;
  for (const Panorama& panorama : library.panoramas) {
    names.push_back(full_name(panorama));
  }
  return names;
}

// To a part of the largest coefficient.
void expect_near(const Coefficients& actual, const Coefficients& expected, double part) {
  ASSERT_EQ(actual.degree, expected.degree);
  for (int c = 0; c < kChannelCount; ++c) {
    for (std::size_t i = 0; i < expected.channels[c].size(); ++i) {
      EXPECT_NEAR(actual.channels[c][i], expected.channels[c][i],
                  part * std::abs(expected.channels[c][0]));
    }
  }
}

Library loaded(const std::vector<std::filesystem::path>& sources) {
  auto library = load_library(sources);
  EXPECT_TRUE(library) << library.error().text();
  return library ? *library : Library();
}

TEST_F(LibraryTest, OfAStoreHasAllThatTheStoreKnows) {
  const auto out = run_library("");
  const Library library = loaded({out});
  EXPECT_EQ(library.title, "out");
  ASSERT_THAT(names_of(library), ElementsAre("c", "a", "b"));  // as in the table
  const Panorama& b = library.panoramas[2];
  EXPECT_EQ(b.file, std::filesystem::canonical(folder / "b.exr"));
  ASSERT_TRUE(b.pixels);
  EXPECT_EQ(b.pixels->format, "OpenEXR half ZIP");
  EXPECT_EQ(b.pixels->width, 64);
  EXPECT_EQ(b.pixels->height, 32);
  EXPECT_EQ(b.pixels->pixel_count, 64 * 32);
  EXPECT_GT(b.pixels->maximum[0], b.pixels->mean[0]);
  ASSERT_EQ(library.failed.size(), 1U);
  EXPECT_EQ(library.failed[0].name, "bad");
  EXPECT_THAT(library.failed[0].error, HasSubstr("bad.hdr"));
  EXPECT_EQ(library.failed[0].file.filename(), "bad.hdr");
}

// Numbers of a table read back as the same doubles, so the store's and the table's are one.
TEST_F(LibraryTest, IsTheSameFromStoreTablesAndFiles) {
  const auto out = run_library("tables: [csv, json]\n");
  const Library stored = loaded({out});
  for (const char* table : {"coefficients.csv", "coefficients.json"}) {
    const Library told = loaded({out / table});
    ASSERT_EQ(names_of(told), names_of(stored));
    for (std::size_t i = 0; i < 3; ++i) {
      EXPECT_EQ(told.panoramas[i].coefficients, stored.panoramas[i].coefficients) << table;
    }
  }
  const Library projected = loaded({folder / "c.hdr", folder / "a.hdr", folder / "b.exr"});
  ASSERT_EQ(names_of(projected), names_of(stored));
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_EQ(projected.panoramas[i].coefficients, stored.panoramas[i].coefficients);
  }
}

// The dark variant is told in another frame; in the native one again, it is a quarter of the light.
TEST_F(LibraryTest, HasVariantsInTheNativeFrame) {
  const auto out =
      run_library("tables: json\nvariants: {plain: {}, dark: {exposure: -2, frame: openexr}}\n");
  const Library library = loaded({out});
  ASSERT_THAT(names_of(library), ElementsAre("c", "c.dark", "a", "a.dark", "b", "b.dark"));
  for (std::size_t i = 0; i < 6; i += 2) {
    Coefficients quarter = library.panoramas[i].coefficients;
    for (auto& channel : quarter.channels) {
      for (double& value : channel) value *= 0.25;
    }
    // Two rotations by signed permutations, of some roundings each.
    expect_near(library.panoramas[i + 1].coefficients, quarter, 1e-13);
    EXPECT_EQ(library.panoramas[i + 1].file, library.panoramas[i].file);
  }
}

// In the table's frame its numbers are told to the last bit, whichever way it was written, and
// irradiance is made of the radiance as the run makes it.
TEST_F(LibraryTest, TellsTheTablesOwnNumbers) {
  for (const char* format : {"csv", "json"}) {
    const auto out = run_library(fmt::format(
        "tables: {}\nvariants: {{plain: {{}}, hann: {{window: hann, rotate: {{yaw: 17}}, frame: "
        "openexr}}}}\n",
        format));
    const auto records = read_table(out / fmt::format("coefficients.{}", format));
    const Library library = loaded({out});
    ASSERT_EQ(2 * library.panoramas.size(), records->size());  // radiance and irradiance
    for (std::size_t i = 0; i < records->size(); ++i) {
      const CoefficientRecord& record = (*records)[i];
      Panorama panorama = library.panoramas[i / 2];
      EXPECT_EQ(panorama.name, record.panorama);
      EXPECT_EQ(coefficients_in(panorama, record.quantity, panorama.frame), record.coefficients);
      panorama.told.erase(Quantity::irradiance);
      EXPECT_EQ(coefficients_in(panorama, record.quantity, panorama.frame), record.coefficients);
    }
  }
}

// What an entry's own keys make of the pixels is what its scenes show, in the native frame although
// a CSV table does not say in which one it is; one that asks for nothing has its pixels' light.
TEST_F(LibraryTest, ShowsTheLightThatTheManifestAskedFor) {
  make_panoramas();
  const Library library = loaded({run_manifest(
      "{file: a.hdr, name: raw, frame: openexr}, "
      "{file: a.hdr, name: turned, frame: openexr, exposure: 1, rotate: {yaw: 90}}")});
  ASSERT_THAT(names_of(library), ElementsAre("raw", "turned"));
  EXPECT_EQ(library.panoramas[0].change, LightChange{});
  Coefficients twice = library.panoramas[0].coefficients;
  for (auto& channel : twice.channels) {
    for (double& value : channel) value *= 2.0;
  }
  const glm::dmat3 turn = *turn_matrix({90.0, 0.0, 0.0});
  expect_near(library.panoramas[1].coefficients, rotate(twice, turn), 1e-13);
  for (int column = 0; column < 3; ++column) {
    const LightChange& change = library.panoramas[1].change;
    EXPECT_NEAR(change.colour[column][column], 2.0, 1e-9);
    EXPECT_LT(glm::length(change.turn[column] - turn[column]), 1e-9);
  }
  EXPECT_THAT(find_panoramas(library, "raw.plain"), ElementsAre(0));
}

// CSV rows do not tell their frame. What lies beside a run's table does, so the light is that of
// the JSON table, which tells it itself; nothing but `otherwise` tells it where the table lies
// alone.
TEST_F(LibraryTest, TakesTheFramesOfCsvFromWhatLiesBesideIt) {
  namespace fs = std::filesystem;
  const auto out = run_library(
      "tables: [csv, json]\nvariants: {plain: {}, turned: {frame: openexr}, y_up: {frame: "
      "'-z,+x,+y'}}\n");
  const fs::path csv = out / "coefficients.csv";
  const Library told = loaded({out / "coefficients.json"});
  const auto expect_told = [&](const Library& library) {
    ASSERT_EQ(names_of(library), names_of(told));
    for (std::size_t i = 0; i < told.panoramas.size(); ++i) {
      EXPECT_EQ(library.panoramas[i].frame, told.panoramas[i].frame);
      EXPECT_EQ(library.panoramas[i].coefficients, told.panoramas[i].coefficients);
    }
    EXPECT_TRUE(library.frameless.empty());
  };
  EXPECT_EQ(told.panoramas[1].frame, *parse_frame("openexr"));
  expect_told(told);
  expect_told(loaded({csv}));  // by the store
  fs::rename(out / "shoal.db", folder / "shoal.db");
  expect_told(loaded({csv}));  // by the JSON table
  // A table of another name is not the run's.
  fs::create_directory(folder / "alone");
  fs::copy_file(csv, out / "mine.csv");
  fs::copy_file(csv, folder / "alone" / "coefficients.csv");
  for (const fs::path& lone : {out / "mine.csv", folder / "alone" / "coefficients.csv"}) {
    const Library native = loaded({lone});
    EXPECT_THAT(native.frameless, ElementsAre(lone));
    EXPECT_EQ(native.panoramas[1].frame, Frame{});
    LoadSettings settings;
    settings.table_frame = *parse_frame("openexr");
    const auto named = load_library({lone}, settings);
    ASSERT_TRUE(named);
    EXPECT_EQ(named->panoramas[1].coefficients, told.panoramas[1].coefficients);
    EXPECT_EQ(named->panoramas[1].frame, told.panoramas[1].frame);
  }
}

// Of panoramas that the store beside a table does not know nothing tells the frame.
TEST_F(LibraryTest, TakesNoFramesFromAnotherRunsStore) {
  const auto out = run_library("defaults: {frame: openexr}\n");
  std::string table = "panorama,variant,quantity,l,m,r,g,b\nstranger,plain,radiance,0,0,1,1,1\n";
  test::write_text(out / "coefficients.csv", table);
  EXPECT_EQ(loaded({out / "coefficients.csv"}).frameless.size(), 1U);
  test::write_text(out / "shoal.db", "no store");
  EXPECT_EQ(loaded({out / "coefficients.csv"}).frameless.size(), 1U);
}

TEST_F(LibraryTest, HasTheManifestsTags) {
  const auto out = run_library("variants: {plain: {}, dark: {exposure: -2}}\n");
  const Library library = loaded({out});
  ASSERT_THAT(names_of(library), ElementsAre("c", "c.dark", "a", "a.dark", "b", "b.dark"));
  EXPECT_THAT(library.panoramas[0].tags, ElementsAre("out", "sun"));
  EXPECT_THAT(library.panoramas[1].tags, ElementsAre("out", "sun"));
  EXPECT_TRUE(library.panoramas[2].tags.empty());
}

TEST_F(LibraryTest, HasTheQualityOfEachVariant) {
  const auto out =
      run_library("defaults: {quality: 8}\nvariants: {plain: {}, soft: {window: hann}}\n");
  const Library library = loaded({out});
  ASSERT_THAT(names_of(library), ElementsAre("c", "c.soft", "a", "a.soft", "b", "b.soft"));
  for (std::size_t i = 0; i < 6; i += 2) {
    ASSERT_TRUE(library.panoramas[i].quality && library.panoramas[i + 1].quality);
    // A window takes light away that was right.
    EXPECT_LT(*library.panoramas[i].quality->rms_error,
              *library.panoramas[i + 1].quality->rms_error);
  }
  EXPECT_FALSE(loaded({out / "coefficients.csv"}).panoramas[0].quality);
}

// A variant's change is told of what the pixels hold, whatever the entry itself makes of them, and
// whatever the light looks like; but not of light that was added or taken out.
TEST_F(LibraryTest, TellsWhatVariantsMakeOfThePixels) {
  make_panoramas();
  const Library library = loaded({run_manifest(
      "{file: a.hdr, exposure: 1, frame: openexr}",
      "variants: {plain: {}, dim: {exposure: -2}, soft: {window: hann}, both: {rotate: {pitch: "
      "30}, matrix: [[0, 1, 0], [0.5, 0, 0], [0, 0, 1]]}, rest: {dominant: remove}}\n")});
  ASSERT_THAT(names_of(library), ElementsAre("a", "a.dim", "a.soft", "a.both", "a.rest"));
  EXPECT_EQ(frame_of(library), *parse_frame("openexr"));
  const auto change = [&](std::size_t i) { return library.panoramas[i].change; };
  EXPECT_EQ(change(0), (LightChange{glm::dmat3(2.0), glm::dmat3(1.0)}));
  EXPECT_EQ(change(1), (LightChange{glm::dmat3(0.25), glm::dmat3(1.0)}));
  EXPECT_EQ(change(2), change(0));
  // Columns: red goes to green by half, green to red; twice, for the entry's exposure.
  EXPECT_EQ(change(3),
            (LightChange{glm::dmat3(0, 1, 0, 2, 0, 0, 0, 0, 2), *turn_matrix({0.0, 30.0, 0.0})}));
  EXPECT_FALSE(change(4).is_whole);
  EXPECT_EQ(change(4).colour, glm::dmat3(2.0)) << "it is exposed like the others";
}

// The pixels of a file lack the lights beside it, and have the sun that was taken out.
TEST_F(LibraryTest, TellsWherePixelsAreNotTheWholeLight) {
  make_panoramas();
  const std::string lamp = "lights: [{ambient: {radiance: 1}}]";
  const std::string sky = "sky: {sun: {elevation: 30}, size: [32, 16]}";
  const Library library =
      loaded({run_manifest("{file: a.hdr, name: a_lit, " + lamp +
                           "}, {file: a.hdr, name: b_sunless, sun: {top: 0.01, action: remove}}, "
                           "{file: a.hdr, name: c_seen, sun: {top: 0.01}}, {name: d_lamp, " +
                           lamp + "}, {name: e_sky, " + sky + ", " + lamp + "}, {name: f_sky, " +
                           sky + ", " + lamp + ", picture: {size: [32, 16]}}")});
  ASSERT_EQ(library.panoramas.size(), 6U);
  const bool whole[] = {false, false, true, true, false, true};
  for (std::size_t i = 0; i < 6; ++i) {
    EXPECT_EQ(library.panoramas[i].change.is_whole, whole[i]) << library.panoramas[i].name;
  }
}

// What was painted of an entry without a file stands for its pixels.
TEST_F(LibraryTest, SeesThePictureOfAnEntryWithoutAFile) {
  const Library library = loaded({run_manifest(
      "{name: day/noon, sky: {sun: {elevation: 60}, size: [32, 16]}, picture: {size: [32, 16]}}, "
      "{name: key, lights: [{ambient: {radiance: 1}}]}")});
  ASSERT_THAT(names_of(library), ElementsAre("day/noon", "key"));
  EXPECT_TRUE(std::filesystem::exists(library.panoramas[0].file)) << library.panoramas[0].file;
  EXPECT_TRUE(library.panoramas[0].pixels);
  EXPECT_EQ(library.panoramas[0].recipe, "");
  EXPECT_TRUE(library.panoramas[1].file.empty());
  EXPECT_NE(library.panoramas[1].recipe, "");
  EXPECT_FALSE(library.panoramas[1].pixels);
}

TEST_F(LibraryTest, GivesBackTheRadianceOfIrradiance) {
  const auto out = run_library("tables: csv\nquantities: irradiance\n");
  const Library stored = loaded({out / "shoal.db"});
  const Library told = loaded({out / "coefficients.csv"});
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_EQ(told.panoramas[i].quantity, Quantity::irradiance);
    expect_near(radiance_of(told.panoramas[i]), stored.panoramas[i].coefficients, 1e-15);
  }
}

// Odd degrees above 1 are what the clamped cosine takes away.
TEST(Radiance, LacksWhatTheCosineTookAway) {
  Panorama panorama;
  panorama.quantity = Quantity::irradiance_over_pi;
  Coefficients radiance(4);
  for (auto& channel : radiance.channels) channel.assign(channel.size(), 1.0);
  panorama.coefficients = apply_quantity(radiance, panorama.quantity);
  const Coefficients back = radiance_of(panorama);
  for (int l = 0; l <= 4; ++l) {
    for (int m = -l; m <= l; ++m) {
      EXPECT_NEAR(back.channels[1][coefficient_index(l, m)], l == 3 ? 0.0 : 1.0, 1e-15);
    }
  }
}

TEST_F(LibraryTest, OfAFolderHasItsPanoramas) {
  make_panoramas();
  std::filesystem::create_directory(folder / "more");
  std::filesystem::copy(folder / "a.hdr", folder / "more" / "a.hdr");
  test::write_text(folder / "notes.txt", "no panorama");
  LoadSettings settings;
  settings.degree = 5;
  const auto library = load_library({folder.path()}, settings);
  ASSERT_TRUE(library) << library.error().text();
  // Two files are called a: their paths tell them apart.
  EXPECT_THAT(names_of(*library), ElementsAre((folder / "a.hdr").string(), "b", "c",
                                              (folder / "more" / "a.hdr").string()));
  EXPECT_EQ(library->panoramas[1].coefficients.degree, 5);
  ASSERT_EQ(library->failed.size(), 1U);
  EXPECT_EQ(library->failed[0].name, "bad");
  EXPECT_THAT(library->failed[0].error, HasSubstr("bad.hdr: "));
  EXPECT_EQ(library->failed[0].file.filename(), "bad.hdr");
}

TEST(FindPanoramas, GoesByNamesAndVariants) {
  Library library;
  for (const auto& [name, variant] : {std::pair{"day/a[1]", ""},
                                      {"day/b", ""},
                                      {"day/b", "dark"},
                                      {"night/c", ""},
                                      {"v1.dark", ""},
                                      {"v1.dark", "dark"}}) {
    library.panoramas.emplace_back().name = name;
    library.panoramas.back().variant = variant;
  }
  const auto found = [&](const char* pattern) { return find_panoramas(library, pattern); };
  EXPECT_THAT(found("*"), ElementsAre(0, 1, 2, 3, 4, 5));
  // A name stands for all its variants, as what it is like does.
  EXPECT_THAT(found("day/b"), ElementsAre(1, 2));
  EXPECT_THAT(found("day/*"), ElementsAre(0, 1, 2));
  EXPECT_THAT(found("?ight/[a-c]"), ElementsAre(3));
  // One of them is named with its variant, plain or not.
  EXPECT_THAT(found("day/b.dark"), ElementsAre(2));
  EXPECT_THAT(found("day/b.plain"), ElementsAre(1));
  EXPECT_THAT(found("day/b.*"), ElementsAre(1, 2));
  EXPECT_THAT(found("*plain"), ElementsAre(0, 1, 3, 4));
  // Names may have dots, and what looks like a variant in them.
  EXPECT_THAT(found("v1.dark"), ElementsAre(4, 5));
  EXPECT_THAT(found("v1.dark.plain"), ElementsAre(4));
  EXPECT_THAT(found("*.dark"), ElementsAre(2, 4, 5));
  // A name is no pattern, though it looks like one.
  EXPECT_THAT(found("day/a[1]"), ElementsAre(0));
  EXPECT_THAT(found("day/a[1].plain"), ElementsAre(0));
  for (const char* nobody : {"b", "plain", "night/c.dark", ""}) {
    EXPECT_TRUE(found(nobody).empty()) << nobody;
  }
}

TEST(CountText, TellsPanoramasAndTheirVariants) {
  Library library;
  const auto text_with = [&](const char* name, const char* variant) {
    library.panoramas.emplace_back().name = name;
    library.panoramas.back().variant = variant;
    return count_text(library);
  };
  EXPECT_EQ(count_text(library), "0 panoramas");
  EXPECT_EQ(text_with("a", ""), "1 panorama");
  EXPECT_EQ(text_with("a", "dark"), "1 panorama, 2 variants");
  EXPECT_EQ(text_with("b", ""), "2 panoramas, 3 variants in all");
  EXPECT_EQ(text_with("b", "dark"), "2 panoramas, 2 variants each");
}

// What is wrong, where, and what to do.
class Refusal : public LibraryTest {
 protected:
  void expect(const std::filesystem::path& source, ErrorCode code, const std::string& text) {
    const auto library = load_library({source});
    ASSERT_FALSE(library) << source;
    EXPECT_EQ(library.error().code, code) << library.error().text();
    EXPECT_THAT(library.error().text(), HasSubstr(text));
    EXPECT_THAT(library.error().text(), HasSubstr(source.filename().string()));
  }
};

TEST_F(Refusal, OfWhatIsNotThere) {
  expect(folder / "nowhere", ErrorCode::not_found, "shoal run");
  std::filesystem::create_directory(folder / "empty");
  expect(folder / "empty", ErrorCode::not_found, "run `shoal run MANIFEST` first");
  test::write_text(folder / "m.yaml", "shoal: 1\n");
  expect(folder / "m.yaml", ErrorCode::usage, "name its output folder");
}

TEST_F(Refusal, OfStores) {
  test::write_text(folder / "cut.db", "SQLite format 3");
  expect(folder / "cut.db", ErrorCode::malformed, "store");
  const auto out = run_library("");
  std::filesystem::resize_file(out / "shoal.db", 8192);
  expect(out / "shoal.db", ErrorCode::malformed, "`shoal run` again");
}

TEST_F(Refusal, OfTables) {
  const std::string head = R"({"schema": "shoal/coefficients", "version": 1, "records": [)";
  const std::vector<std::pair<std::string, std::string>> tables = {
      {"a.json", "{"},
      {"b.json", "[1]"},
      {"c.json", R"({"schema": 3})"},
      {"d.json", head + R"({"panorama": "p", "quantity": "radiance", "frame": "native", )" +
                     R"("degree": 1, "coefficients": [[1, 2, 3]]}]})"},
      {"e.json", head + R"({"panorama": [], "quantity": "radiance"}]})"},
      {"f.json", head + R"([]]})"},
      {"g.csv", "panorama,quantity\n"}};
  for (const auto& [name, text] : tables) {
    test::write_text(folder / name, text);
    expect(folder / name, ErrorCode::malformed, "edited");
  }
  test::write_text(folder / "t.npy", "\x93NUMPY");
  expect(folder / "t.npy", ErrorCode::unsupported, "csv");
}

TEST(PartOf, HasThesePanoramasInThisOrderAndWhatFailed) {
  Library library;
  library.title = "skies";
  for (const char* name : {"a", "b", "c"}) library.panoramas.emplace_back().name = name;
  library.failed.push_back({"d", "why"});
  const std::size_t chosen[] = {2, 0};
  const Library part = part_of(library, chosen);
  EXPECT_EQ(part.title, "skies");
  ASSERT_EQ(part.panoramas.size(), 2u);
  EXPECT_EQ(part.panoramas[0].name, "c");
  EXPECT_EQ(part.panoramas[1].name, "a");
  ASSERT_EQ(part.failed.size(), 1u);
  EXPECT_EQ(part.failed[0].name, "d");
}

}  // namespace
}  // namespace shoal::viz
