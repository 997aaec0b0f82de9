#include "batch/fingerprint.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>
#include <map>
#include <set>
#include <utility>
#include <vector>

namespace shoal {
namespace {

using SettingsChange = std::pair<const char*, std::function<void(EntrySettings&)>>;
using ManifestChange = std::pair<const char*, std::function<void(Manifest&)>>;

// Every field that a projection depends on, each changed from its default.
const std::vector<SettingsChange>& projection_changes() {
  static const std::vector<SettingsChange> kChanges = {
      {"layer", [](EntrySettings& s) { s.read.layer = "diffuse"; }},
      {"part", [](EntrySettings& s) { s.read.part = "diffuse"; }},
      {"rgbe_decode", [](EntrySettings& s) { s.read.rgbe_decode = RgbeDecode::center; }},
      {"encoding", [](EntrySettings& s) { s.read.encoding = Encoding::linear; }},
      {"degree", [](EntrySettings& s) { s.projection.degree = 3; }},
      {"midpoint", [](EntrySettings& s) { s.projection.quadrature = Quadrature::midpoint; }},
      {"fejer", [](EntrySettings& s) { s.projection.quadrature = Quadrature::fejer; }},
      {"octahedral", [](EntrySettings& s) { s.projection.layout = Layout::octahedral; }},
      {"any layout", [](EntrySettings& s) { s.projection.layout = Layout::automatic; }},
      {"nonfinite",
       [](EntrySettings& s) { s.projection.pixels.nonfinite = PixelPolicy::NonFinite::zero; }},
      {"negative",
       [](EntrySettings& s) { s.projection.pixels.negative = PixelPolicy::Negative::zero; }},
      {"clamp", [](EntrySettings& s) { s.projection.pixels.clamp = 100.0; }},
      {"a clamp one bit away",
       [](EntrySettings& s) { s.projection.pixels.clamp = std::nextafter(100.0, 200.0); }},
      {"clamp_percentile", [](EntrySettings& s) { s.projection.pixels.clamp_percentile = 99.9; }},
      {"sun by top", [](EntrySettings& s) { s.projection.sun.top = 0.001; }},
      {"sun by level", [](EntrySettings& s) { s.projection.sun.above = 10.0; }},
      {"sun taken out",
       [](EntrySettings& s) {
         s.projection.sun = {0.0, 11.0, SunSettings::Action::remove};
       }},
      {"sun replaced",
       [](EntrySettings& s) {
         s.projection.sun = {0.0, 11.0, SunSettings::Action::replace};
       }},
      {"reference", [](EntrySettings& s) { s.projection.arithmetic = Arithmetic::reference; }},
  };
  return kChanges;
}

// Everything linear, in whichever LinearKeys.
const std::vector<std::pair<const char*, std::function<void(LinearKeys&)>>>& linear_changes() {
  static const std::vector<std::pair<const char*, std::function<void(LinearKeys&)>>> kChanges = {
      {"exposure", [](LinearKeys& k) { k.exposure_stops = 1.0; }},
      {"scale", [](LinearKeys& k) { k.scale = 3.0; }},
      {"matrix", [](LinearKeys& k) { k.matrix = glm::dmat3(1, 2, 0, 0, 1, 0, 0, 0, 1); }},
      {"transposed", [](LinearKeys& k) { k.matrix = glm::dmat3(1, 0, 0, 2, 1, 0, 0, 0, 1); }},
      {"white", [](LinearKeys& k) { k.white = glm::dvec3(1, 1, 2); }},
      {"white of ones", [](LinearKeys& k) { k.white = glm::dvec3(1, 1, 1); }},
      {"frame", [](LinearKeys& k) { k.frame = *parse_frame("+z,-x,+y"); }},
      {"yaw",
       [](LinearKeys& k) {
         k.turn = PictureTurn{10.0, 0.0, 0.0};
       }},
      {"pitch",
       [](LinearKeys& k) {
         k.turn = PictureTurn{0.0, 10.0, 0.0};
       }},
      {"hann",
       [](LinearKeys& k) {
         k.window = {WindowFit::given, {WindowKind::hann, {}}};
       }},
      {"wider",
       [](LinearKeys& k) {
         k.window = {WindowFit::given, {WindowKind::hann, 9.0}};
       }},
      {"gauss",
       [](LinearKeys& k) {
         k.window = {WindowFit::given, {WindowKind::gauss, {}}};
       }},
      {"without dominant", [](LinearKeys& k) { k.dominant = DominantPart::remove; }},
      {"dominant alone", [](LinearKeys& k) { k.dominant = DominantPart::only; }},
      {"auto",
       [](LinearKeys& k) {
         k.window = {WindowFit::automatic, {}};
       }},
  };
  return kChanges;
}

PanoramaEntry entry() {
  PanoramaEntry entry;
  entry.name = "a/b";
  entry.file = "/library/a/b.exr";
  return entry;
}

void change_linear(PanoramaEntry& entry, const std::function<void(LinearKeys&)>& change) {
  EntrySettings settings = *entry.settings;
  change(settings.linear);
  entry.settings = std::make_shared<EntrySettings>(settings);
}

Manifest manifest() {
  Manifest manifest;
  manifest.entries = {entry()};
  manifest.variants = {{"plain", {}, {}}};
  manifest.quantities = {Quantity::radiance};
  manifest.tables = {TableFormat::csv};
  manifest.maps = {MapRequest{}};
  return manifest;
}

// A hash tells two values apart if no two of these are the same.
void expect_all_different(const std::map<std::string, std::string>& hash_by_name) {
  std::map<std::string, std::string> seen;
  for (const auto& [name, hash] : hash_by_name) {
    const auto [at, is_new] = seen.emplace(hash, name);
    EXPECT_TRUE(is_new) << name << " and " << at->second << ": " << hash;
  }
}

TEST(Fingerprint, EveryParameterOfAProjectionChangesItsText) {
  std::map<std::string, std::string> texts = {{"default", parameter_text({})}};
  for (const auto& [name, change] : projection_changes()) {
    EntrySettings changed;
    change(changed);
    texts[name] = parameter_text(changed);
  }
  expect_all_different(texts);
}

TEST(Fingerprint, ParametersReadBack) {
  std::vector<EntrySettings> all(2);
  for (const auto& [name, change] : projection_changes()) {
    all.emplace_back();
    change(all.back());
    change(all[1]);  // all of them at once
  }
  const std::vector<std::string> texts = {"a \"quoted\" one",
                                          "back\\slash",
                                          "two\nlines",
                                          "{flow: [seq, #no comment]}",
                                          "true",
                                          "1.0",
                                          "K\u00fcche \u5149",
                                          " blanks ",
                                          "~",
                                          "a: b",
                                          "- a",
                                          "'"};
  for (const std::string& text : texts) {
    all.emplace_back().read.layer = text;
    all.emplace_back().read.part = text;
  }
  for (const double clamp : {1e-300, 0.1, 65504.0, 1.0 / 3.0, std::numeric_limits<double>::max()}) {
    all.emplace_back().projection.pixels.clamp = clamp;
  }
  for (const EntrySettings& expected : all) {
    const std::string text = parameter_text(expected);
    EXPECT_EQ(text.find('\n'), std::string::npos) << "one line: " << text;
    const auto read = parse_parameters(text);
    ASSERT_TRUE(read) << read.error().text();
    EXPECT_EQ(read->read.layer, expected.read.layer);
    EXPECT_EQ(read->read.part, expected.read.part);
    EXPECT_EQ(read->read.rgbe_decode, expected.read.rgbe_decode);
    EXPECT_EQ(read->read.encoding, expected.read.encoding);
    EXPECT_EQ(read->projection.degree, expected.projection.degree);
    EXPECT_EQ(read->projection.quadrature, expected.projection.quadrature);
    EXPECT_EQ(read->projection.layout, expected.projection.layout);
    EXPECT_EQ(read->projection.pixels.nonfinite, expected.projection.pixels.nonfinite);
    EXPECT_EQ(read->projection.pixels.negative, expected.projection.pixels.negative);
    EXPECT_EQ(read->projection.pixels.clamp, expected.projection.pixels.clamp) << text;
    EXPECT_EQ(read->projection.pixels.clamp_percentile,
              expected.projection.pixels.clamp_percentile);
    EXPECT_EQ(read->projection.sun, expected.projection.sun);
    EXPECT_EQ(read->projection.arithmetic, expected.projection.arithmetic);
  }
}

TEST(Fingerprint, WhatIsNoParameterTextIsAnError) {
  const std::string good = parameter_text({});
  for (const std::string& text : {std::string(), std::string("{"), std::string("[1, 2]"),
                                  std::string("{degree: 2}"), good.substr(0, good.size() / 2)}) {
    const auto read = parse_parameters(text);
    ASSERT_FALSE(read) << text;
    EXPECT_EQ(read.error().code, ErrorCode::malformed) << text;
  }
}

// What changes no bit of a projection must not make anything run again.
TEST(Fingerprint, NothingElseIsAParameter) {
  EntrySettings other;
  other.tags = {"tag"};
  other.lights = {AmbientLight{glm::dvec3(1.0)}};
  other.read.rows_per_band = 3;
  for (const auto& [name, change] : linear_changes()) change(other.linear);
  EXPECT_EQ(parameter_text(other), parameter_text({}));
}

TEST(Fingerprint, OutputHashChangesWithAllThatMapsDependOn) {
  const std::vector<ManifestChange> changes = {
      {"kind", [](Manifest& m) { m.maps[0].kind = Quantity::radiance; }},
      {"layout", [](Manifest& m) { m.maps[0].layout = MapLayout::cube; }},
      {"cube-openexr", [](Manifest& m) { m.maps[0].layout = MapLayout::cube_openexr; }},
      {"width", [](Manifest& m) { m.maps[0].width = 401; }},
      {"height", [](Manifest& m) { m.maps[0].height = 401; }},
      {"format", [](Manifest& m) { m.maps[0].format = MapFileType::hdr; }},
      {"samples", [](Manifest& m) { m.maps[0].samples = MapSamples::single; }},
      {"faces", [](Manifest& m) { m.maps[0].faces = CubeFaces::files; }},
      {"preview_stops", [](Manifest& m) { m.maps[0].preview_stops = 1.0; }},
      {"suffix", [](Manifest& m) { m.maps[0].suffix = "x"; }},
      {"two maps", [](Manifest& m) { m.maps.push_back(m.maps[0]); }},
      {"no maps", [](Manifest& m) { m.maps.clear(); }},
      {"variant's name", [](Manifest& m) { m.variants[0].name = "soft"; }},
      {"two variants",
       [](Manifest& m) {
         m.variants.push_back({"soft", {}, {}});
       }},
      {"name", [](Manifest& m) { m.entries[0].name = "c"; }},
  };
  const auto hash = [](const Manifest& m) { return output_hash(m, m.entries[0]); };
  std::map<std::string, std::string> hashes = {{"default", hash(manifest())}};
  for (const auto& [name, change] : changes) {
    Manifest changed = manifest();
    change(changed);
    hashes[name] = hash(changed);
  }
  // A cube map, for an equirect one lies as its panorama does in every frame.
  Manifest cube = manifest();
  cube.maps[0].layout = MapLayout::cube;
  for (const auto& [name, change] : linear_changes()) {
    Manifest changed = cube;
    change_linear(changed.entries[0], change);
    hashes[std::string("entry's ") + name] = hash(changed);
    // The same said by the variant is the same.
    Manifest in_variant = cube;
    change(in_variant.variants[0].linear);
    EXPECT_EQ(hash(in_variant), hash(changed)) << name;
  }
  expect_all_different(hashes);

  Manifest in_frame = manifest();
  change_linear(in_frame.entries[0],
                [](LinearKeys& keys) { keys.frame = parse_frame("openexr").value(); });
  EXPECT_EQ(hash(in_frame), hash(manifest())) << "an equirect map does not know its frame";

  Manifest tables_only = manifest();
  tables_only.quantities = {Quantity::irradiance};
  tables_only.tables = {TableFormat::json};
  EXPECT_EQ(hash(tables_only), hash(manifest())) << "tables are no business of maps";
}

TEST(Fingerprint, WithoutMapsNothingLinearMatters) {
  Manifest plain = manifest();
  plain.maps.clear();
  Manifest changed = plain;
  for (const auto& [name, change] : linear_changes()) change_linear(changed.entries[0], change);
  EXPECT_EQ(output_hash(changed, changed.entries[0]), output_hash(plain, plain.entries[0]));
}

TEST(Fingerprint, TableHashChangesWithAllThatRowsDependOn) {
  const std::vector<ManifestChange> changes = {
      {"quantity", [](Manifest& m) { m.quantities = {Quantity::irradiance}; }},
      {"order",
       [](Manifest& m) {
         m.quantities = {Quantity::irradiance, Quantity::radiance};
       }},
      {"other order",
       [](Manifest& m) {
         m.quantities = {Quantity::radiance, Quantity::irradiance};
       }},
      {"variant's name", [](Manifest& m) { m.variants[0].name = "soft"; }},
      {"two variants",
       [](Manifest& m) {
         m.variants.push_back({"soft", {}, {}});
       }},
  };
  const auto hash = [](const Manifest& m) { return table_hash(m, *m.entries[0].settings); };
  std::map<std::string, std::string> hashes = {{"default", hash(manifest())}};
  for (const auto& [name, change] : changes) {
    Manifest changed = manifest();
    change(changed);
    hashes[name] = hash(changed);
  }
  for (const auto& [name, change] : linear_changes()) {
    Manifest changed = manifest();
    change_linear(changed.entries[0], change);
    hashes[std::string("entry's ") + name] = hash(changed);
  }
  expect_all_different(hashes);

  Manifest maps_only = manifest();
  maps_only.maps[0].width = 17;
  EXPECT_EQ(hash(maps_only), hash(manifest())) << "maps are no business of tables";
}

// Made once for all that share their settings, and never kept for one that does not, though the
// settings before be gone and their place taken.
TEST(Fingerprint, ATextOfSettingsIsMadeWhereTheyDiffer) {
  int count = 0;
  SettingsText text([&count](const EntrySettings& settings) {
    ++count;
    return parameter_text(settings);
  });
  PanoramaEntry a = entry();
  PanoramaEntry b = a;
  EXPECT_EQ(text.of(a), parameter_text({}));
  EXPECT_EQ(text.of(b), parameter_text({}));
  EXPECT_EQ(count, 1);
  for (const auto& [name, change] : projection_changes()) {
    EntrySettings settings;
    change(settings);
    a.settings.reset();
    b.settings.reset();
    b.settings = std::make_shared<EntrySettings>(settings);
    EXPECT_EQ(text.of(b), parameter_text(settings)) << name;
  }
  EXPECT_EQ(count, 1 + static_cast<int>(projection_changes().size()));
}

}  // namespace
}  // namespace shoal
