#include "library/pixels.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "made_library.h"

namespace shoal::viz {
namespace {

using test::LibraryTest;
using testing::Each;
using testing::HasSubstr;
using testing::SizeIs;

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
  EXPECT_THAT(cache.why_empty(3), HasSubstr("has no picture"));
  EXPECT_EQ(cache.why_empty(1), "");
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
