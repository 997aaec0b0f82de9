#include "window/picture.h"

#include <gtest/gtest.h>

#include <fstream>
#include <sstream>

#include "window/picture_difference.h"

namespace shoal::viz {
namespace {

Picture ramp(int width, int height) {
  Picture picture{{width, height}, {}};
  for (int i = 0; i < 3 * width * height; ++i) {
    picture.rgb.push_back(static_cast<unsigned char>(i * 7));
  }
  return picture;
}

std::string content_of(const std::filesystem::path& path) {
  std::ifstream stream(path, std::ios::binary);
  std::ostringstream text;
  text << stream.rdbuf();
  return text.str();
}

std::filesystem::path temporary(const std::string& name) {
  return std::filesystem::path(testing::TempDir()) / ("shoal-" + name);
}

TEST(Picture, ComesBackFromPngAsItWas) {
  for (const auto& [width, height] : {std::pair(1, 1), {3, 2}, {257, 31}}) {
    const Picture picture = ramp(width, height);
    const auto path = temporary("picture.png");
    ASSERT_TRUE(write_png(picture, path));
    const auto back = read_png(path);
    ASSERT_TRUE(back) << back.error().text();
    EXPECT_EQ(*back, picture);
    std::filesystem::remove(path);
  }
}

TEST(Picture, PngHasTheSameBytesTwiceAndNoTime) {
  const auto first = temporary("first.png");
  const auto second = temporary("second.png");
  ASSERT_TRUE(write_png(ramp(64, 48), first));
  ASSERT_TRUE(write_png(ramp(64, 48), second));
  EXPECT_EQ(content_of(first), content_of(second));
  EXPECT_EQ(content_of(first).find("tIME"), std::string::npos);
  std::filesystem::remove(first);
  std::filesystem::remove(second);
}

TEST(Picture, TellsWhatIsNoPng) {
  const auto path = temporary("no.png");
  EXPECT_EQ(read_png(path).error().code, ErrorCode::not_found);
  std::ofstream(path) << "P3 1 1 255";
  EXPECT_EQ(read_png(path).error().code, ErrorCode::malformed);
  std::filesystem::remove(path);
}

TEST(Picture, CannotBeWrittenWhereThereIsAFile) {
  const auto file = temporary("file");
  std::ofstream(file) << "x";
  EXPECT_EQ(write_png(ramp(2, 2), file / "a.png").error().code, ErrorCode::write_failed);
  std::filesystem::remove(file);
}

TEST(PictureDifference, OfOnePictureIsNone) {
  const auto difference = compare_pictures(ramp(9, 5), ramp(9, 5));
  ASSERT_TRUE(difference);
  EXPECT_EQ(difference->largest, 0);
  EXPECT_EQ(difference->mean, 0.0);
  EXPECT_EQ(difference->share, 0.0);
}

// Of 10 pixels one differs by 3, 20 and 5 in its channels: it counts with 20, which is above 16.
TEST(PictureDifference, CountsThePixelsLargestChannel) {
  Picture a{{5, 2}, std::vector<unsigned char>(30, 100)};
  Picture b = a;
  b.rgb[12] = 103;
  b.rgb[13] = 80;
  b.rgb[14] = 105;
  const auto difference = compare_pictures(a, b);
  ASSERT_TRUE(difference);
  EXPECT_EQ(difference->largest, 20);
  EXPECT_EQ(difference->mean, 2.0);
  EXPECT_EQ(difference->share, 0.1);
  EXPECT_EQ(compare_pictures(a, b, 20)->share, 0.0);
  const Picture seen = difference_picture(a, b);
  EXPECT_EQ(seen.rgb[13], 160);
  EXPECT_EQ(seen.rgb[0], 0);
}

TEST(PictureDifference, NeedsOneSize) {
  const auto difference = compare_pictures(ramp(4, 2), ramp(2, 4));
  ASSERT_FALSE(difference);
  EXPECT_EQ(difference.error().what, "one picture is 4x2, the other 2x4");
}

}  // namespace
}  // namespace shoal::viz
