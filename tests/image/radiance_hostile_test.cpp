// Radiance files that are cut off, damaged or made to hurt: one clear error each, never a crash.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "image/panorama_pixels.h"
#include "image/radiance_file.h"
#include "image/radiance_source.h"
#include "support/temporary_folder.h"

namespace shoal {
namespace {

using test::RowCoding;
using test::Scanline;
using ::testing::HasSubstr;

class HostileRadiance : public ::testing::Test {
 protected:
  Result<test::PanoramaPixels> read(const std::string& bytes) {
    test::write_bytes(file_, bytes);
    return test::read_all(open_radiance(file_, {}));
  }

  // 16 x 6 texels in all three encodings.
  std::string mixed_file(const std::string& resolution) {
    std::string bytes = test::radiance_header(resolution);
    for (int y = 0; y < 6; ++y) {
      bytes += test::coded_row(test::random_scanline(random_, 16), static_cast<RowCoding>(y % 3));
    }
    return bytes;
  }

  test::TemporaryFolder folder_;
  std::filesystem::path file_ = folder_ / "picture.hdr";
  test::RandomNumbers random_{11};
};

// Wherever a file ends too early, it is malformed; once the header is plausible, the row is named.
TEST_F(HostileRadiance, CutOffAtEveryByte) {
  for (const std::string resolution : {"-Y 6 +X 16", "+X 6 -Y 16"}) {
    const std::string whole = mixed_file(resolution);
    ASSERT_TRUE(read(whole));
    int rows_named = 0;
    for (std::size_t size = 0; size < whole.size(); ++size) {
      const auto pixels = read(whole.substr(0, size));
      ASSERT_FALSE(pixels) << size;
      EXPECT_EQ(pixels.error().code, ErrorCode::malformed) << size;
      if (pixels.error().what.find("cut off by the end") != std::string::npos) ++rows_named;
    }
    EXPECT_GT(rows_named, 50);
  }
}

TEST_F(HostileRadiance, CutOffSaysWhereAndHowMuchIsGood) {
  for (const bool from_top : {true, false}) {
    std::string bytes = test::radiance_header(from_top ? "-Y 100 +X 4" : "+Y 100 +X 4");
    for (int y = 0; y < 70; ++y) bytes += test::flat_row(Scanline(4, {128, 0, 0, 128}));
    const auto error = read(bytes).error();
    const std::string row = from_top ? "70" : "29";  // of the picture, from its top
    EXPECT_EQ(error.where, file_.string() + ':' + row);
    EXPECT_EQ(error.what, "row " + row + " is cut off by the end of the file; 70 of 100 are good");
  }
}

// Each rule of the encodings, broken. Width 9, so that new RLE is possible.
TEST_F(HostileRadiance, BrokenScanlines) {
  const std::string pixel("\x80\x80\x80\x80", 4);
  const struct {
    std::string row, fault;
  } cases[] = {
      {std::string("\2\2\0\10", 4) + std::string(72, 'x'), "another width"},
      {std::string("\2\2\0\11\0", 5) + std::string(72, 'x'), "run of no pixels"},
      {std::string("\2\2\0\11\x8a\1", 6) + std::string(72, 'x'), "beyond its end"},
      {std::string("\2\2\0\11\x0a", 5) + std::string(72, 'x'), "beyond its end"},
      {std::string("\1\1\1\11", 4) + std::string(72, 'x'), "before there is one"},
      {pixel + "\1\1\1\11" + std::string(72, 'x'), "beyond its end"},
      {pixel + std::string("\1\1\1\0\1\1\1\1", 8) + std::string(72, 'x'), "beyond its end"},
      {pixel + std::string("\1\1\1\0\1\1\1\0\1\1\1\0\1\1\1\0\1\1\1\1", 20) + std::string(72, 'x'),
       "more than four"},
  };
  for (const auto& [row, fault] : cases) {
    const auto pixels = read(test::radiance_header("-Y 1 +X 9") + row);
    ASSERT_FALSE(pixels) << fault;
    EXPECT_EQ(pixels.error().code, ErrorCode::malformed);
    EXPECT_THAT(pixels.error().what, HasSubstr(fault));
    EXPECT_THAT(pixels.error().what, HasSubstr("row 0"));
  }
}

// Any damage gives pixels or an error. What it must not give, sanitisers and crashes would tell.
TEST_F(HostileRadiance, RandomDamage) {
  const std::string whole = mixed_file("-Y 6 +X 16");
  int errors = 0, pictures = 0;
  for (int round = 0; round < 3000; ++round) {
    std::string bytes = whole;
    for (int flips = 1 + random_.below(4); flips > 0; --flips) {
      bytes[random_.below(static_cast<int>(bytes.size()))] = static_cast<char>(random_.below(256));
    }
    const auto pixels = read(bytes);
    if (pixels) {
      ++pictures;
    } else {
      ++errors;
      EXPECT_FALSE(pixels.error().what.empty());
    }
  }
  EXPECT_GT(errors, 100);
  EXPECT_GT(pictures, 100);
}

}  // namespace
}  // namespace shoal
