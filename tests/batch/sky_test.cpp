// Skies and pictures of a manifest: what is read of them, and what a run makes of them.
#include <gmock/gmock.h>

#include <cmath>

#include "batch/library_folder.h"
#include "batch/painted_light.h"
#include "batch/verify.h"
#include "output/coefficient_table.h"
#include "sphere/linear_operations.h"

namespace shoal {
namespace {

using ::testing::HasSubstr;
using ::testing::IsEmpty;

constexpr std::string_view kSun = "sun: {elevation: 40, azimuth: 120}";

class SkyTest : public test::LibraryTest {
 protected:
  // A manifest of one sky, with further keys of the sky, of the entry and of the manifest.
  static std::string one_sky(const std::string& sky = "", const std::string& entry = "",
                             const std::string& more = "") {
    return "shoal: 1\noutput: out\nquantities: radiance\npanoramas: [{name: day, sky: {" +
           std::string(kSun) + ", size: [64, 32]" + sky + "}" + entry + "}]\n" + more;
  }

  Coefficients coefficients(const std::string& panorama = "day") {
    auto records = read_csv_table(folder_ / "out/coefficients.csv");
    EXPECT_TRUE(records) << records.error().text();
    for (const CoefficientRecord& record : *records) {
      if (record.panorama == panorama) return record.coefficients;
    }
    ADD_FAILURE() << panorama;
    return {};
  }

  std::string told(const std::string& entry) {
    return messages("shoal: 1\npanoramas: [{name: a, " + entry + "}]\n");
  }
};

TEST_F(SkyTest, EveryKeyIsRead) {
  const Manifest manifest = manifest_of(
      "shoal: 1\npanoramas: [{name: day, sky: {turbidity: 4.5, sun: {elevation: 12, azimuth: -30}, "
      "ground: [0.1, 0.2, 0.3], size: [200, 100], disk: hidden}, picture: {size: [20, 10], format: "
      "hdr}}, {name: plain, sky: {sun: {elevation: 1}}, picture: {type: half}}]\n");
  const EntrySettings& day = *manifest.entries[0].settings;
  EXPECT_EQ(day.origin, LightOrigin::sky);
  const SkyKey expected{{4.5, 12, -30, glm::dvec3(0.1, 0.2, 0.3)}, SunDisk::hidden, 200, 100};
  EXPECT_EQ(*day.sky, expected);
  const PictureFile picture = picture_file(manifest.entries[0]);
  EXPECT_EQ(picture.name, "maps/day.picture.hdr");
  EXPECT_EQ(picture.width, 20);
  const EntrySettings& plain = *manifest.entries[1].settings;
  EXPECT_EQ(*plain.sky, (SkyKey{{3.0, 1, 0, glm::dvec3(0.2)}, SunDisk::shown, 1024, 512}));
  EXPECT_EQ(plain.picture->samples, MapSamples::half);
  EXPECT_EQ(picture_file(manifest.entries[1]).name, "maps/plain.picture.exr");
  EXPECT_EQ(picture_file(manifest.entries[1]).height, 512) << "that of the sky";
}

TEST_F(SkyTest, WhatIsWrongIsTold) {
  EXPECT_THAT(told("sky: {turbidity: 3}"), HasSubstr("a sky needs its sun"));
  EXPECT_THAT(told("sky: {sun: {azimuth: 3}}"), HasSubstr("a sun needs elevation"));
  EXPECT_THAT(told("sky: {sun: {elevation: -2}}"),
              HasSubstr("elevation must be a number of degrees of arc from 0 to 90"));
  EXPECT_THAT(told("sky: {sun: {elevation: 2}, turbidity: 1}"), HasSubstr("from 2 to 10"));
  EXPECT_THAT(told("sky: {sun: {elevation: 2}, ground: 2}"), HasSubstr("from 0 to 1"));
  EXPECT_THAT(told("sky: {sun: {elevation: 2}, size: [3.5, 4]}"), HasSubstr("whole numbers"));
  EXPECT_THAT(told("sky: {sun: {elevation: 2}, disc: shown}"), HasSubstr("did you mean \"disk\"?"));
  EXPECT_THAT(told("sky: {sun: {elevation: 2}}, exclude: x"), HasSubstr("not with a sky"));
  EXPECT_THAT(messages("shoal: 1\npanoramas: [{sky: {sun: {elevation: 2}}}]\n"),
              HasSubstr("an entry of a sky needs a name"));
  EXPECT_THAT(messages("shoal: 1\ndefaults: {sky: {}}\npanoramas: []\n"),
              HasSubstr("it belongs to a panorama"));
  touch({"a.hdr"});
  EXPECT_THAT(told("file: a.hdr, sky: {sun: {elevation: 2}}"),
              HasSubstr("sky does not go with file"));
  EXPECT_THAT(told("file: a.hdr, picture: {}"), HasSubstr("picture does not go with file"));
  EXPECT_THAT(told("lights: [{ambient: {radiance: 1}}], picture: {format: hdr, type: half}"),
              HasSubstr("type is for format: exr only"));
}

// Added up: the pixels, the sun in closed form beside them, and lights of the entry's frame. The
// ground is lit by a hidden sun as well.
TEST_F(SkyTest, TheSunIsBesideThePixels) {
  run(one_sky(", disk: hidden"));
  const Coefficients hidden = coefficients();
  run(one_sky());
  const Coefficients shown = coefficients();
  const PreethamModel model({3.0, 40, 120, glm::dvec3(0.2)});
  const AnalyticLight sun = model.sun();
  EXPECT_EQ(shown, add(hidden, project_lights(std::span(&sun, 1), 2)));
  run(one_sky("", ", frame: openexr, lights: [{ambient: {radiance: 2}}]"));
  EXPECT_NEAR(coefficients().channels[1][0] - shown.channels[1][0], 2 * std::sqrt(4 * M_PI), 1e-12);
}

// A sky is processed once; whatever is said of it makes it run again, and nothing else does.
TEST_F(SkyTest, ASkyIsUpToDate) {
  EXPECT_EQ(run(one_sky()).summary.done_count, 1);
  EXPECT_EQ(run(one_sky()).reasons.at("day"), "up to date");
  for (const std::string change :
       {", turbidity: 3.25", ", ground: 0.25", ", disk: hidden", ", ground: [0.2, 0.2, 0.25]"}) {
    EXPECT_EQ(run(one_sky(change)).reasons.at("day"), "its parameters changed") << change;
  }
  EXPECT_EQ(run(one_sky("", ", degree: 3")).reasons.at("day"), "its parameters changed");
}

// The same tables and pictures from any number of threads.
TEST_F(SkyTest, TheSameBytesForAnyNumberOfThreads) {
  const std::string text = one_sky("", ", picture: {size: [50, 25], format: hdr}",
                                   "maps: [{kind: irradiance, size: [16, 8]}]\n");
  RunOptions options;
  options.threads = 1;
  run(text, options);
  const auto one = outputs();
  EXPECT_EQ(one.count("maps/day.picture.hdr"), 1u);
  remove_outputs();
  options.threads = 4;
  run(text, options);
  EXPECT_EQ(outputs(), one);
}

// The picture holds all of the entry, sun and lights too: projected as a file, it gives the entry's
// coefficients within the sampling error, here of a sun of 0.5 degrees in texels of 1.4.
TEST_F(SkyTest, ThePictureHoldsEverything) {
  const std::string lights =
      ", frame: openexr, lights: [{cosine: {direction: [0, -1, 0.2], radiance: [9, 3, 1]}}, "
      "{directional: {direction: [1, 2, 0], irradiance: 40}}]";
  run(one_sky("", lights + ", picture: {size: [256, 128]}",
              "variants: {plain: {frame: native, exposure: 0}}\n"));
  const Coefficients entry = coefficients();
  const auto path = folder_ / "out/maps/day.picture.exr";
  ProjectionTables tables;
  const auto picture = project_panorama(path, {}, {}, tables);
  ASSERT_TRUE(picture) << picture.error().text();
  for (int c = 0; c < kChannelCount; ++c) {
    for (std::size_t i = 0; i < entry.channels[c].size(); ++i) {
      EXPECT_NEAR(picture->radiance.channels[c][i], entry.channels[c][i],
                  0.01 * entry.channels[c][0]);
    }
  }
}

// Exposure and rotation wait for the coefficients; a picture is what is there before.
TEST_F(SkyTest, ThePictureIsRedoneWhereItIsAskedForDifferently) {
  const auto text = [](const std::string& picture) {
    return one_sky("", ", exposure: 1, picture: " + picture);
  };
  EXPECT_EQ(run(text("{format: hdr}")).summary.map_count, 1);
  const std::string before = test::content_of(folder_ / "out/maps/day.picture.hdr");
  EXPECT_EQ(run(text("{format: hdr}")).reasons.at("day"), "up to date");
  const Ran smaller = run(text("{format: hdr, size: [8, 4]}"));
  EXPECT_EQ(smaller.work.at("day"), ItemWork::outputs);
  EXPECT_NE(test::content_of(folder_ / "out/maps/day.picture.hdr"), before);
  std::filesystem::remove(folder_ / "out/maps/day.picture.hdr");
  EXPECT_EQ(run(text("{format: hdr, size: [8, 4]}")).work.at("day"), ItemWork::outputs);
  EXPECT_TRUE(std::filesystem::exists(folder_ / "out/maps/day.picture.hdr"));
}

TEST_F(SkyTest, LightsAloneHaveAPictureToo) {
  run("shoal: 1\noutput: out\nquantities: radiance\npanoramas: [{name: set/key, lights: [{disk: "
      "{direction: [1, 0, 1], radius: 20, radiance: 5}}], picture: {size: [128, 64], type: "
      "half}}]\n");
  ProjectionTables tables;
  const auto picture = project_panorama(folder_ / "out/maps/set/key.picture.exr", {}, {}, tables);
  ASSERT_TRUE(picture) << picture.error().text();
  // Texels of 2.8 degrees, a disk of 20: well within a percent.
  const Coefficients exact = coefficients("set/key");
  for (std::size_t i = 0; i < exact.channels[0].size(); ++i) {
    EXPECT_NEAR(picture->radiance.channels[0][i], exact.channels[0][i],
                0.01 * exact.channels[0][0]);
  }
}

TEST_F(SkyTest, VerifyPaintsItAgain) {
  run(one_sky("", ", picture: {format: hdr}"));
  const std::atomic<bool> stop{false};
  VerifyOptions options;
  options.recompute = VerifyOptions::Recompute::yes;
  const auto sound = verify_outputs(folder_ / "out", options, stop);
  ASSERT_TRUE(sound) << sound.error().text();
  EXPECT_THAT(sound->problems, IsEmpty());
  EXPECT_EQ(sound->recomputed_count, 1);
  write("out/maps/day.picture.hdr", "something else");
  const auto changed = verify_outputs(folder_ / "out", options, stop);
  ASSERT_EQ(changed->problems.size(), 1u);
  EXPECT_THAT(changed->problems[0], HasSubstr("day.picture.hdr"));
}

}  // namespace
}  // namespace shoal
