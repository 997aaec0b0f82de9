// What rotations, windows, views and lights of a manifest come out as.
#include <gmock/gmock.h>

#include <numbers>

#include "batch/manifest.h"
#include "manifest_folder.h"

namespace shoal {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

class ManifestLights : public test::ManifestTest {
 protected:
  // A manifest of one panorama with these keys.
  ManifestResult load_entry(const std::string& keys) {
    touch({"a.hdr"});
    return load("shoal: 1\npanoramas: [{file: a.hdr, " + keys + "}]\n");
  }
};

TEST_F(ManifestLights, EveryKindOfLight) {
  const ManifestResult result = load_entry(
      "frame: '+z,-x,+y', lights: ["
      "{ambient: {radiance: 0.5}}, "
      "{directional: {direction: [0, 0, 2], irradiance: [1, 2, 3]}}, "
      "{disk: {direction: [0, 1, 0], radius: 90, radiance: -1}}, "
      "{cap: {direction: [1, 0, 0], radius: 180, radiance: 2}}, "
      "{cosine: {direction: [1, 1, 1], radiance: [0, 0, 1]}}]");
  ASSERT_TRUE(result.manifest) << result.messages;
  // The picture's centre, the frame's +z, is -x of the native frame; its upper edge +z; and -x of
  // the frame is -y of the native one.
  const auto lights = native_lights(*result.manifest->entries[0].settings);
  ASSERT_EQ(lights.size(), 5u);
  EXPECT_EQ(std::get<AmbientLight>(lights[0]).radiance, glm::dvec3(0.5));
  EXPECT_EQ(std::get<DirectionalLight>(lights[1]).direction, glm::dvec3(-2, 0, 0));
  EXPECT_EQ(std::get<DirectionalLight>(lights[1]).irradiance, glm::dvec3(1, 2, 3));
  EXPECT_EQ(std::get<DiskLight>(lights[2]).direction, glm::dvec3(0, 0, 1));
  EXPECT_EQ(std::get<DiskLight>(lights[2]).angular_radius, std::numbers::pi / 2);
  EXPECT_EQ(std::get<DiskLight>(lights[2]).radiance, glm::dvec3(-1));
  EXPECT_EQ(std::get<DiskLight>(lights[3]).direction, glm::dvec3(0, 1, 0));
  EXPECT_EQ(std::get<CosineLobe>(lights[4]).radiance, glm::dvec3(0, 0, 1));
}

// A light is told in its entry's frame, whatever frame a variant is written in.
TEST_F(ManifestLights, StandAloneUnderAName) {
  const ManifestResult result = load(
      "shoal: 1\npanoramas: [{name: set/key, lights: [{ambient: {radiance: 1}}]}]\n"
      "variants: {plain: {}, other: {frame: openexr}}\n");
  ASSERT_TRUE(result.manifest) << result.messages;
  EXPECT_THAT(names(result), ElementsAre("set/key"));
  const PanoramaEntry& entry = result.manifest->entries[0];
  EXPECT_EQ(entry.file, "");
  EXPECT_EQ(entry.settings->origin, LightOrigin::lights);
}

TEST_F(ManifestLights, WhatIsWrongWithThemIsTold) {
  const auto told = [&](const std::string& light) {
    return load_entry("lights: [" + light + "]").messages;
  };
  EXPECT_THAT(told("{disk: {direction: [0, 0, 1], radiance: 1}}"),
              HasSubstr("a disk needs radius"));
  EXPECT_THAT(told("{disk: {direction: [0, 0, 0], radius: 1, radiance: 1}}"),
              HasSubstr("this direction is zero"));
  EXPECT_THAT(told("{disk: {direction: [0, 1, 0], radius: 181, radiance: 1}}"),
              HasSubstr("radius must be a number of degrees of arc above 0, at most 180"));
  EXPECT_EQ(
      load_entry("lights: [{disk: {direction: [0, 1, 0], radius: 190, radiance: 1}}]").error_count,
      1)
      << "what is wrong once is told once";
  EXPECT_THAT(told("{ambient: {radiance: 1}, cosine: {}}"), HasSubstr("a light is one kind"));
  EXPECT_THAT(told("{sun: {radiance: 1}}"), HasSubstr("unknown key \"sun\" in a light"));
  EXPECT_THAT(told("{ambient: {radiance: [1, 2]}}"), HasSubstr("a number or a list of three"));
  EXPECT_THAT(messages("shoal: 1\npanoramas: [{lights: [{ambient: {radiance: 1}}]}]\n"),
              HasSubstr("needs a name"));
  EXPECT_THAT(messages("shoal: 1\npanoramas: [{name: a, lights: []}]\n"),
              HasSubstr("neither a file nor a light"));
}

// The three ways to tell a quarter turn about the vertical of the openexr frame, which is +y there:
// by the right-hand formula +z goes to +x, and +x is a quarter turn left of the centre.
TEST_F(ManifestLights, ARotationIsToldInThreeWays) {
  std::vector<glm::dmat3> turns;
  for (const std::string turn :
       {"{yaw: -90}", "{axis: [0, 3, 0], angle: 90}", "{quaternion: [1, 0, 1, 0]}"}) {
    const ManifestResult result = load_entry("frame: openexr, rotate: " + turn);
    ASSERT_TRUE(result.manifest) << result.messages;
    const auto matrix =
        turn_of(*result.manifest->entries[0].settings, result.manifest->variants[0]);
    ASSERT_TRUE(matrix) << matrix.error().text();
    turns.push_back(*matrix);
  }
  for (const glm::dmat3& turn : turns) {
    for (int column = 0; column < 3; ++column) {
      // A quaternion is normalised: a few roundings.
      EXPECT_LT(glm::length(turn[column] - turns[0][column]), 1e-15);
    }
  }
  // What was at the centre, -x of the native frame, is a quarter turn to the left of it, +y there.
  EXPECT_EQ(turns[0] * glm::dvec3(-1, 0, 0), glm::dvec3(0, 1, 0));
  EXPECT_THAT(load_entry("rotate: {yaw: 1, axis: [0, 0, 1]}").messages,
              HasSubstr("mixes two ways"));
  EXPECT_THAT(load_entry("rotate: {axis: [0, 0, 1]}").messages, HasSubstr("axis and angle"));
  EXPECT_THAT(load_entry("rotate: {axis: [0, 0, 0], angle: 1}").messages, HasSubstr("axis"));
}

TEST_F(ManifestLights, WindowsAreWordsOrHaveAParameter) {
  const auto window = [&](const std::string& keys) {
    const ManifestResult result = load_entry(keys);
    EXPECT_TRUE(result.manifest) << result.messages;
    return window_of(*result.manifest->entries[0].settings, result.manifest->variants[0]);
  };
  EXPECT_EQ(window("degree: 3"), WindowKey{});
  EXPECT_EQ(window("window: hann"), (WindowKey{WindowFit::given, {WindowKind::hann, {}}}));
  EXPECT_EQ(window("window: {gauss: 0.5}"),
            (WindowKey{WindowFit::given, {WindowKind::gauss, 0.5}}));
  EXPECT_EQ(window("window: auto"), (WindowKey{WindowFit::automatic, {}}));
  EXPECT_THAT(load_entry("window: {hann: -3}").messages, HasSubstr("width"));
  EXPECT_THAT(load_entry("window: {hann: 3, gauss: 1}").messages, HasSubstr("one kind"));
  EXPECT_THAT(load_entry("window: autom").messages, HasSubstr("did you mean \"auto\"?"));
}

TEST_F(ManifestLights, ViewsSpreadAVariant) {
  touch({"a.hdr"});
  const std::string one = "shoal: 1\npanoramas: [{file: a.hdr}]\n";
  const ManifestResult result = load(one +
                                     "variants: {plain: {}, set: {exposure: 1, views: 12}, all: "
                                     "{views: {count: 3, over: all}}}\n");
  ASSERT_TRUE(result.manifest) << result.messages;
  const auto& variants = result.manifest->variants;
  ASSERT_EQ(variants.size(), 1u + 12 + 3);
  EXPECT_EQ(variants[1].name, "set-01");
  EXPECT_EQ(variants[12].name, "set-12");
  EXPECT_EQ(variants[15].name, "all-3");
  EXPECT_EQ(variants[5].linear.exposure_stops, 1.0);
  EXPECT_FALSE(variants[0].view);
  const EntrySettings& settings = *result.manifest->entries[0].settings;
  EXPECT_EQ(*turn_of(settings, variants[1]), glm::dmat3(1.0)) << "the first is not turned";
  // A quarter turn: the centre moves to the right, from -x to -y.
  EXPECT_EQ(*turn_of(settings, variants[4]) * glm::dvec3(-1, 0, 0), glm::dvec3(0, -1, 0));
  EXPECT_THAT(messages(one + "variants: {x: {views: 2}, x-1: {}}\n"),
              HasSubstr("two variants are named \"x-1\""));
  EXPECT_THAT(messages(one + "variants: {x: {views: {over: all}}}\n"), HasSubstr("needs a count"));
  EXPECT_THAT(messages(one + "variants: {x: {views: 0}}\n"), HasSubstr("from 1 to 10000"));
}

// Samples are a file's: an entry without one must not seem to have its sun taken out. Defaults are
// for files, too.
TEST_F(ManifestLights, SunAndClampAreForFiles) {
  const std::string begin = "shoal: 1\ndefaults: {clamp: 3, sun: {top: 0.001}}\npanoramas:\n";
  const std::string sky = "{name: a, sky: {sun: {elevation: 3}}";
  const std::string lights = "{name: b, lights: [{ambient: {radiance: 1}}]";
  EXPECT_THAT(load(begin + "  - " + sky + ", sun: {top: 0.01}}\n").messages,
              HasSubstr("sun is for the pixels of a file, not for a sky"));
  EXPECT_THAT(load(begin + "  - " + lights + ", clamp: 1}\n").messages,
              HasSubstr("clamp is for the pixels of a file, not for lights alone"));
  touch({"a.hdr"});
  const ManifestResult result =
      load(begin + "  - {file: a.hdr, name: c}\n  - " + sky + "}\n  - " + lights + "}\n");
  ASSERT_TRUE(result.manifest) << result.messages;
  for (const PanoramaEntry& entry : result.manifest->entries) {
    const ProjectionSettings& projection = entry.settings->projection;
    EXPECT_EQ(projection.sun.asked(), entry.name == "c") << entry.name;
    EXPECT_EQ(projection.pixels.clamp > 0.0, entry.name == "c") << entry.name;
  }
}

}  // namespace
}  // namespace shoal
