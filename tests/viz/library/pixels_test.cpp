#include "library/pixels.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "made_library.h"
#include "sphere/turns.h"

namespace shoal::viz {
namespace {

using test::LibraryTest;
using testing::Each;
using testing::HasSubstr;
using testing::SizeIs;
using testing::StartsWith;

void write_constant(const std::filesystem::path& path, float red, float green, float blue) {
  const float rgb[] = {red, green, blue};
  test::write_picture(shoal::test::make_picture(64, 32, [&](int c, int, int) { return rgb[c]; }),
                      MapFormat::exr_float, path);
}

TEST_F(LibraryTest, HasPreviewsInTheOrderAskedFor) {
  write_constant(folder / "red.exr", 1, 0, 0);
  write_constant(folder / "-odd name\".exr", 0, 0, 4);
  test::write_text(folder / "bad.hdr", "no picture");
  const auto previews =
      load_previews({folder / "-odd name\".exr", folder / "bad.hdr", folder / "red.exr",
                     folder / "nowhere.exr", folder / "red.exr"},
                    16);
  ASSERT_THAT(previews, SizeIs(5));
  ASSERT_TRUE(previews[0]) << previews[0].error().text();
  EXPECT_EQ(previews[0]->width, 16);
  EXPECT_EQ(previews[0]->height, 8);
  EXPECT_EQ(previews[0]->at(7, 15)[0], 0.0F);
  EXPECT_EQ(previews[0]->at(7, 15)[2], 4.0F);
  ASSERT_FALSE(previews[1]);
  EXPECT_THAT(previews[1].error().text(), HasSubstr("bad.hdr"));
  ASSERT_TRUE(previews[2]);
  EXPECT_EQ(previews[2]->at(0, 0)[0], 1.0F);
  ASSERT_FALSE(previews[3]);
  EXPECT_THAT(previews[3].error().text(), HasSubstr("nowhere.exr"));
  EXPECT_TRUE(previews[4]);
}

// Of a file whose row is at fault the program names file and row, and these words are enough.
TEST_F(LibraryTest, NamesAFileThatIsCutOffOnce) {
  const auto file = folder / "cut.hdr";
  test::write_picture(test::make_noisy_picture(32, 16, 1), MapFormat::hdr, file);
  std::filesystem::resize_file(file, 1000);
  const auto previews = load_previews({file}, 16);
  ASSERT_FALSE(previews[0]);
  const std::string why = previews[0].error().text();
  EXPECT_THAT(why, StartsWith(file.string() + ":"));
  EXPECT_EQ(why.find("cut.hdr"), why.rfind("cut.hdr")) << why;
}

TEST_F(LibraryTest, CachesPixels) {
  write_constant(folder / "grey.exr", 0.5, 0.5, 0.5);
  Library library;
  library.panoramas.resize(4);
  for (const int i : {0, 1}) library.panoramas[i].file = folder / "grey.exr";
  library.panoramas[2].file = folder / "nowhere.exr";
  PixelCache cache(library);
  cache.expect({0, 1, 2, 3});
  const Pixels& pixels = cache.get(1, 8);
  EXPECT_THAT(pixels.rgb, SizeIs(3 * 8 * 4));
  EXPECT_THAT(pixels.rgb, Each(0.5F));
  // All were loaded together: what is asked for now needs no file.
  std::filesystem::remove(folder / "grey.exr");
  EXPECT_EQ(&cache.get(1, 8), &pixels);
  EXPECT_FALSE(cache.get(1, 8).empty());
  EXPECT_TRUE(cache.get(2, 8).empty());
  const std::string why = cache.why_empty(2);
  EXPECT_THAT(why, HasSubstr("nowhere.exr"));
  EXPECT_EQ(why.find("nowhere.exr"), why.rfind("nowhere.exr")) << why;
  EXPECT_TRUE(cache.get(3, 8).empty());
  EXPECT_THAT(cache.why_empty(3), HasSubstr("coefficients alone"));
  EXPECT_EQ(cache.why_empty(1), "");
}

// A panorama's pixels are those of its light: a red texel that is turned a quarter to the right and
// made half as bright, of 64 columns.
TEST_F(LibraryTest, ChangesPixelsAsTheLightIs) {
  test::write_picture(
      shoal::test::make_picture(
          64, 32, [](int c, int i, int j) { return c == 0 && i == 12 && j == 5 ? 8.0F : 0.0F; }),
      MapFormat::exr_float, folder / "red.exr");
  Library library;
  library.panoramas.resize(1);
  library.panoramas[0].file = folder / "red.exr";
  library.panoramas[0].change = {glm::dmat3(0.5), *turn_matrix({90.0, 0.0, 0.0})};
  PixelCache cache(library);
  EXPECT_NEAR(cache.get(0, 64).at(12, 21)[0], 4.0F, 1e-6F);
  EXPECT_EQ(cache.get(0, 64).at(12, 5)[0], 0.0F);
  EXPECT_EQ(cache.get(0, 64, Lying::as_in_file).at(12, 5)[0], 4.0F);
}

// What a store says of skies and lights paints them to the bit as the picture that the manifest
// could have asked for, but for a disk's radius, which goes through degrees of arc.
TEST_F(LibraryTest, PaintsWhatHasNoFile) {
  const std::string sky =
      "sky: {turbidity: 4, sun: {elevation: 40, azimuth: -70}, ground: [0.1, "
      "0.2, 0.3], disk: hidden, size: [32, 16]}";
  const std::string lights =
      "lights: [{disk: {direction: [1, 2, 1], radius: 35, radiance: [3, 2, 1]}}, {ambient: "
      "{radiance: 0.5}}, {cosine: {direction: [0, -1, 0.5], radiance: 2}}]";
  const std::string picture = ", picture: {size: [64, 32]}";
  const auto library = load_library({run_manifest(
      "{name: a, " + sky + "}, {name: b, " + sky + picture + "}, {name: c, " + lights +
      "}, {name: d, " + lights + picture +
      "}, {name: e, lights: [{directional: {direction: [0, 0, 1], irradiance: 1}}]}")});
  ASSERT_TRUE(library) << library.error().text();
  ASSERT_THAT(library->panoramas, SizeIs(5));
  PixelCache cache(*library);
  cache.expect({0, 1, 2, 3, 4});
  for (const std::size_t i : {0, 2}) {
    const Pixels painted = cache.get(i, 64);
    const Pixels& written = cache.get(i + 1, 64);
    ASSERT_EQ(painted.rgb.size(), written.rgb.size()) << cache.why_empty(i);
    for (std::size_t k = 0; k < painted.rgb.size(); ++k) {
      ASSERT_NEAR(painted.rgb[k], written.rgb[k], 1e-6F * (1.0F + written.rgb[k])) << i << ' ' << k;
    }
  }
  // A directional light from above is all around the pole.
  const Pixels& above = cache.get(4, 64);
  ASSERT_FALSE(above.empty()) << cache.why_empty(4);
  EXPECT_GT(*std::max_element(above.at(0, 0), above.at(1, 0)), 0.0F);
  EXPECT_EQ(*std::max_element(above.at(1, 0), above.rgb.data() + above.rgb.size()), 0.0F);
}

// An angular map whose centre is red and whose rim is blue: in the preview, the same as an equirect
// picture, red is in the middle.
TEST_F(LibraryTest, ShowsOtherLayoutsAsTheyLie) {
  const auto picture = shoal::test::make_picture(64, 64, [](int c, int i, int j) {
    const bool is_front = std::hypot(i - 31.5, j - 31.5) < 12;
    return c == (is_front ? 0 : 2) ? 1.0 : 0.0;
  });
  test::write_picture(picture, MapFormat::exr_float, folder / "probe.exr");
  Library library;
  library.panoramas.resize(1);
  library.panoramas[0].file = folder / "probe.exr";
  library.panoramas[0].layout = Layout::angular;
  PixelCache cache(library);
  const Pixels& pixels = cache.get(0, 32);
  ASSERT_EQ(pixels.width, 32);
  EXPECT_EQ(pixels.at(8, 16)[0], 1.0F);
  EXPECT_EQ(pixels.at(8, 0)[2], 1.0F);
  EXPECT_EQ(pixels.at(0, 16)[0], 0.0F) << "up is half way to the rim";
}

// Whatever the number of files, each batch fits on a command line, in order and without gaps.
TEST(CommandLineBatches, HoldAllTextsOnce) {
  const std::vector<std::string> texts(10'000, std::string(200, 'x'));
  const auto batches = command_line_batches(texts);
  ASSERT_GT(batches.size(), 1U);
  std::size_t next = 0;
  for (const Range& batch : batches) {
    EXPECT_EQ(batch.begin, next);
    EXPECT_LT((batch.end - batch.begin) * 209, std::size_t{1} << 20);
    next = batch.end;
  }
  EXPECT_EQ(next, texts.size());
  EXPECT_TRUE(command_line_batches({}).empty());
}

}  // namespace
}  // namespace shoal::viz
