// What a right manifest comes out as. Wrong ones: manifest_{syntax,values,files}_test.cpp.
#include "batch/manifest.h"

#include <gmock/gmock.h>

#include <cstdlib>

#include "manifest_folder.h"

namespace shoal {
namespace {

using ::testing::ElementsAre;

class ManifestLoad : public test::ManifestTest {};

TEST_F(ManifestLoad, SmallestHasDefaults) {
  touch({"a.hdr"});
  const ManifestResult result = load("shoal: 1\npanoramas:\n  - file: a.hdr\n");
  ASSERT_TRUE(result.manifest) << result.messages;
  const Manifest& manifest = *result.manifest;
  EXPECT_EQ(manifest.output, folder_ / "out");
  EXPECT_THAT(manifest.quantities, ElementsAre(Quantity::radiance, Quantity::irradiance));
  EXPECT_THAT(manifest.tables, ElementsAre(TableFormat::csv));
  EXPECT_TRUE(manifest.maps.empty());
  ASSERT_EQ(manifest.variants.size(), 1u);
  EXPECT_EQ(manifest.variants[0].name, "plain");

  ASSERT_EQ(manifest.entries.size(), 1u);
  const PanoramaEntry& entry = manifest.entries[0];
  EXPECT_EQ(entry.name, "a");
  EXPECT_EQ(entry.file, folder_ / "a.hdr");
  EXPECT_EQ(entry.origin->loc.line, 3);
  EXPECT_EQ(entry.origin->loc.column, 5);
  EXPECT_EQ(entry.settings->projection.degree, 2);
  EXPECT_EQ(entry.settings->projection.quadrature, Quadrature::texel);
  EXPECT_EQ(entry.settings->projection.pixels.nonfinite, PixelPolicy::NonFinite::error);
  EXPECT_EQ(entry.settings->projection.pixels.negative, PixelPolicy::Negative::keep);
  EXPECT_EQ(entry.settings->projection.pixels.clamp, 0.0);
  EXPECT_EQ(entry.settings->read.rgbe_decode, RgbeDecode::floor);
  EXPECT_EQ(entry.settings->read.encoding, Encoding::srgb);
  const ColourOperations colour = colour_of(*entry.settings, manifest.variants[0]);
  EXPECT_EQ(*combined_matrix(colour), glm::dmat3(1.0));
  EXPECT_EQ(frame_of(*entry.settings, manifest.variants[0]), Frame{});
}

TEST_F(ManifestLoad, EveryKeyOfAnEntry) {
  touch({"a.exr"});
  const ManifestResult result = load(R"(shoal: 1
panoramas:
  - file: a.exr
    name: key/light
    tags: [one, "two words"]
    degree: 64
    quadrature: fejer
    nonfinite: zero
    negative: zero
    clamp: 1e5
    rgbe_decode: center
    encoding: linear
    layer: beauty
    part: 2
    exposure: -1.5
    scale: +0.5
    matrix: [[1, 2, 3], [4, 5, 6], [7, 8, 9]]
    white: [1, 0.5, 0.25]
    frame: {center: +z, right: -x, up: +y}
)");
  ASSERT_TRUE(result.manifest) << result.messages;
  const PanoramaEntry& entry = result.manifest->entries[0];
  EXPECT_EQ(entry.name, "key/light");
  EXPECT_THAT(entry.settings->tags, ElementsAre("one", "two words"));
  EXPECT_EQ(entry.settings->projection.degree, 64);
  EXPECT_EQ(entry.settings->projection.quadrature, Quadrature::fejer);
  EXPECT_EQ(entry.settings->projection.pixels.nonfinite, PixelPolicy::NonFinite::zero);
  EXPECT_EQ(entry.settings->projection.pixels.negative, PixelPolicy::Negative::zero);
  EXPECT_EQ(entry.settings->projection.pixels.clamp, 1e5);
  EXPECT_EQ(entry.settings->read.rgbe_decode, RgbeDecode::center);
  EXPECT_EQ(entry.settings->read.encoding, Encoding::linear);
  EXPECT_EQ(entry.settings->read.layer, "beauty");
  EXPECT_EQ(entry.settings->read.part, "2");
  EXPECT_EQ(entry.settings->linear.exposure_stops, -1.5);
  EXPECT_EQ(entry.settings->linear.scale, 0.5);
  // The manifest spells rows; new red = 1 r + 2 g + 3 b.
  EXPECT_EQ(*entry.settings->linear.matrix * glm::dvec3(1, 10, 100), glm::dvec3(321, 654, 987));
  EXPECT_EQ(entry.settings->linear.white, glm::dvec3(1, 0.5, 0.25));
  EXPECT_EQ(entry.settings->linear.frame, *parse_frame("openexr"));
}

TEST_F(ManifestLoad, EntriesOverrideDefaultsAndVariantsReplace) {
  touch({"a.hdr", "b.hdr"});
  const ManifestResult result = load(R"(shoal: 1
defaults: {degree: 4, exposure: 1, scale: 3, tags: [all]}
panoramas:
  - {file: a.hdr}
  - {file: b.hdr, degree: 8, exposure: 2, tags: mine}
variants: {plain: {}, dark: {exposure: -2, frame: three}, empty: }
)");
  ASSERT_TRUE(result.manifest) << result.messages;
  const auto& [a, b] = std::tie(result.manifest->entries[0], result.manifest->entries[1]);
  const auto& variants = result.manifest->variants;
  ASSERT_EQ(variants.size(), 3u);
  EXPECT_EQ(a.settings->projection.degree, 4);
  EXPECT_EQ(b.settings->projection.degree, 8);
  EXPECT_THAT(a.settings->tags, ElementsAre("all"));
  EXPECT_THAT(b.settings->tags, ElementsAre("mine"));
  EXPECT_EQ(colour_of(*a.settings, variants[0]).exposure_stops, 1.0);
  EXPECT_EQ(colour_of(*b.settings, variants[0]).exposure_stops, 2.0);
  EXPECT_EQ(colour_of(*b.settings, variants[1]).exposure_stops, -2.0);
  EXPECT_EQ(colour_of(*b.settings, variants[1]).scale, 3.0);
  EXPECT_EQ(colour_of(*b.settings, variants[2]).exposure_stops, 2.0);
  EXPECT_EQ(frame_of(*b.settings, variants[1]), *parse_frame("three"));
}

TEST_F(ManifestLoad, MapsAndTheirFiles) {
  touch({"sub/a.hdr"});
  const std::string maps = R"(
maps:
  - {kind: irradiance}
  - {kind: irradiance_over_pi, size: [64, 32], type: float, suffix: small}
  - {kind: radiance, layout: cube, size: 16, format: hdr}
  - {kind: radiance, layout: cube, faces: files, suffix: six}
  - {kind: radiance, format: png, exposure: -1.5}
)";
  const std::string head = "shoal: 1\npanoramas: [{files: \"**/*.hdr\"}]";
  const ManifestResult result = load(head + maps);
  ASSERT_TRUE(result.manifest) << result.messages;
  const Manifest& manifest = *result.manifest;
  ASSERT_EQ(manifest.maps.size(), 5u);
  EXPECT_EQ(manifest.maps[0].width, 400);
  EXPECT_EQ(manifest.maps[0].height, 200);
  EXPECT_EQ(manifest.maps[0].samples, MapSamples::half);
  EXPECT_EQ(manifest.maps[1].samples, MapSamples::single);
  EXPECT_EQ(manifest.maps[1].width, 64);
  EXPECT_EQ(manifest.maps[2].width, 16);
  EXPECT_EQ(manifest.maps[2].height, 16);
  EXPECT_EQ(manifest.maps[3].width, 32);
  EXPECT_EQ(manifest.maps[4].preview_stops, -1.5);

  const auto files = [](const Manifest& of, int map, int variant) {
    return map_files(of, of.entries[0], of.variants[variant], of.maps[map]);
  };
  EXPECT_THAT(files(manifest, 0, 0), ElementsAre("maps/sub/a.irradiance.exr"));
  EXPECT_THAT(files(manifest, 1, 0), ElementsAre("maps/sub/a.irradiance_over_pi.small.exr"));
  EXPECT_THAT(files(manifest, 2, 0), ElementsAre("maps/sub/a.radiance.cube.hdr"));
  EXPECT_THAT(
      files(manifest, 3, 0),
      ElementsAre("maps/sub/a.radiance.cube.six.px.exr", "maps/sub/a.radiance.cube.six.nx.exr",
                  "maps/sub/a.radiance.cube.six.py.exr", "maps/sub/a.radiance.cube.six.ny.exr",
                  "maps/sub/a.radiance.cube.six.pz.exr", "maps/sub/a.radiance.cube.six.nz.exr"));
  EXPECT_THAT(files(manifest, 4, 0), ElementsAre("maps/sub/a.radiance.png"));

  const ManifestResult two = load(head + maps + "variants: {plain: {}, dark: {exposure: -1}}\n");
  ASSERT_TRUE(two.manifest) << two.messages;
  EXPECT_THAT(files(*two.manifest, 0, 1), ElementsAre("maps/sub/a.dark.irradiance.exr"));
}

TEST_F(ManifestLoad, NamesFromPaths) {
  touch({"lib/a.hdr", "lib/a.exr", "lib/sub/b.hdr", "lib/v1.2.hdr", "other/c.hdr", "\u65e5.hdr",
         "lib/.hdr"});
  const ManifestResult result = load(R"(shoal: 1
panoramas:
  - files: "lib/**/*.{hdr,exr}"
  - files: [other/c.hdr, "*.hdr"]
  - {file: lib/.hdr}
)");
  // a.exr and a.hdr would be equal without their extensions; a name of one dot has none.
  EXPECT_THAT(names(result), ElementsAre("a.exr", "a.hdr", "sub/b", "v1.2", "c", "\u65e5", ".hdr"));
}

TEST_F(ManifestLoad, ExtensionsStayAcrossEntries) {
  touch({"a.hdr", "a.exr", "b.hdr"});
  const ManifestResult result =
      load("shoal: 1\npanoramas: [{files: \"*.hdr\"}, {files: \"*.exr\"}]\n");
  EXPECT_THAT(names(result), ElementsAre("a.hdr", "b", "a.exr"));
}

TEST_F(ManifestLoad, ExcludesAndOverlaps) {
  touch({"lib/a.hdr", "lib/a_thumb.hdr", "lib/old/b.hdr", "lib/x/c.hdr", "lib/x/d.hdr"});
  const ManifestResult result = load(R"(shoal: 1
panoramas:
  - files: ["lib/**/*.hdr", "lib/*.hdr"]
    exclude: ["*_thumb*", old, "x/d.*"]
)");
  EXPECT_THAT(names(result), ElementsAre("a", "x/c"));
  EXPECT_EQ(result.messages, "");
  const ManifestResult spelt_out = load(R"(shoal: 1
panoramas:
  - files: "lib/**/*.hdr"
    exclude: "lib/{x,old}/**"
)");
  EXPECT_THAT(names(spelt_out), ElementsAre("a", "a_thumb"));
}

TEST_F(ManifestLoad, ItsOwnMapsAreNoPanoramas) {
  touch({"a.exr", "out/maps/a.irradiance.exr", "out/exports/a.exr", "out/kept.exr"});
  const std::string text = "shoal: 1\npanoramas: [{files: \"**/*.exr\"}]\noutput: ";
  EXPECT_THAT(names(load(text + "out\n")), ElementsAre("a", "out/kept"));
  EXPECT_THAT(names(load(text + "out/../out/\n")), ElementsAre("a", "out/kept"));
  EXPECT_THAT(names(load(text + "elsewhere\n")),
              ElementsAre("a", "out/exports/a", "out/kept", "out/maps/a.irradiance"));
}

TEST_F(ManifestLoad, Variables) {
  touch({"lib/in/a.hdr", "$x/b.hdr", "${x}/c.hdr"});
  const std::string text = R"(shoal: 1
vars: {library: "${root}/in", root: lib, stops: 2, suffix: dr}
panoramas:
  - {files: "${library}/*.h${suffix}", exposure: "${stops}", degree: "${degree}"}
  - {file: $x/b.hdr}
  - {file: "$${x}/c.hdr"}
output: ${env:SHOAL_TEST_OUTPUT}/x
)";
  ::setenv("SHOAL_TEST_OUTPUT", "from-environment", 1);
  const ManifestResult result =
      load(text, {.sets = {{"stops", "0"}, {"stops", "3"}, {"degree", "5"}}});
  ::unsetenv("SHOAL_TEST_OUTPUT");
  ASSERT_TRUE(result.manifest) << result.messages;
  EXPECT_THAT(names(result), ElementsAre("a", "b", "c"));
  EXPECT_EQ(result.manifest->entries[0].settings->linear.exposure_stops, 3.0);
  EXPECT_EQ(result.manifest->entries[0].settings->projection.degree, 5);
  EXPECT_EQ(result.manifest->output, folder_ / "from-environment/x");
}

TEST_F(ManifestLoad, SetsAreTakenLiterally) {
  touch({"a.hdr"});
  const ManifestResult result = load("shoal: 1\npanoramas: [{file: a.hdr, layer: \"${x}\"}]\n",
                                     {.sets = {{"x", "${y} $${"}}});
  ASSERT_TRUE(result.manifest) << result.messages;
  EXPECT_EQ(result.manifest->entries[0].settings->read.layer, "${y} $${");
}

TEST_F(ManifestLoad, Includes) {
  touch({"lib/a.hdr", "b.hdr", "lib/deep/c.hdr"});
  write("lib/library.yaml", R"(shoal: 1
include: ${below}/deep.yaml
vars: {extension: exr, below: nowhere}
defaults: {degree: 3, scale: 2}
panoramas: [{files: "*.${extension}"}]
variants: {plain: {}, dark: {exposure: -1}}
tables: [json, npy]
output: there
)");
  write("lib/deep/deep.yaml",
        "shoal: 1\ndefaults: {degree: 9, negative: zero}\npanoramas: [{file: c.hdr}]\n");
  const ManifestResult result = load(R"(shoal: 1
include: [lib/library.yaml, lib/deep/deep.yaml]
vars: {extension: hdr, below: deep}
defaults: {degree: 5}
panoramas: [{file: b.hdr}]
variants: {dark: {exposure: -3}, light: {exposure: 1}}
tables: csv
)");
  ASSERT_TRUE(result.manifest) << result.messages;
  EXPECT_THAT(names(result), ElementsAre("c", "a", "b"));  // included ones first, each file once
  for (const PanoramaEntry& entry : result.manifest->entries) {
    EXPECT_EQ(entry.settings->projection.degree, 5) << entry.name;
    EXPECT_EQ(entry.settings->linear.scale, 2.0) << entry.name;
    EXPECT_EQ(entry.settings->projection.pixels.negative, PixelPolicy::Negative::zero)
        << entry.name;
  }
  std::vector<std::string> variants;
  for (const Variant& variant : result.manifest->variants) variants.push_back(variant.name);
  EXPECT_THAT(variants, ElementsAre("plain", "dark", "light"));
  EXPECT_EQ(result.manifest->variants[1].linear.exposure_stops, -3.0);
  EXPECT_THAT(result.manifest->tables, ElementsAre(TableFormat::csv));
  EXPECT_EQ(result.manifest->output, folder_ / "lib/there");  // relative to who says it
}

TEST_F(ManifestLoad, ByteOrderMarkAndWindowsLineEnds) {
  touch({"a.hdr"});
  EXPECT_THAT(names(load("\xef\xbb\xbfshoal: 1\r\npanoramas:\r\n  - file: a.hdr\r\n")),
              ElementsAre("a"));
}

TEST_F(ManifestLoad, WarningsDoNotStop) {
  touch({"a.hdr"});
  const ManifestResult result =
      load("shoal: 1\npanoramas:\n  - files: \"*.hdr\"\n    exclude: b*\n");
  EXPECT_TRUE(result.manifest);
  EXPECT_EQ(result.error_count, 0);
  ASSERT_EQ(result.diagnostics.size(), 1u);
  EXPECT_EQ(result.diagnostics[0].severity, Severity::warning);
}

}  // namespace
}  // namespace shoal
