// Which reader a file gets: told by its first bytes, whatever its name is.
#include "image/panorama_source.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>

#include "image/map_writer.h"
#include "image/oiio_picture.h"
#include "image/panorama_pixels.h"
#include "image/radiance_file.h"
#include "support/temporary_folder.h"
#include "support/test_data.h"

namespace shoal {
namespace {

using ::testing::HasSubstr;

class OpenPanorama : public ::testing::Test {
 protected:
  void SetUp() override { ::setenv("SHOAL_MODULE_PATH", SHOAL_TEST_MODULE_FOLDER, 1); }

  static Result<std::unique_ptr<PanoramaSource>> open(const std::filesystem::path& path) {
    return open_panorama(path, {}, portable_chunk_codecs());
  }

  test::TemporaryFolder folder_;
  std::filesystem::path file_ = folder_ / "picture.jpg";  // which none of them is
};

TEST_F(OpenPanorama, ByFirstBytesNotByName) {
  test::write_bytes(file_, test::radiance_header("-Y 1 +X 1") + "\x80\x80\x80\x80");
  auto source = open(file_);
  ASSERT_TRUE(source) << source.error().text();
  EXPECT_EQ((*source)->info().format, "Radiance RGBE");

  const float grey[2] = {0.5f, 0.5f};
  auto writer = MapWriter::create(file_, {MapFormat::exr_float, 2, 1, 0.0, {}});
  ASSERT_TRUE(writer);
  ASSERT_TRUE((*writer)->write_rows({grey, grey, grey}, 2, 1));
  ASSERT_TRUE((*writer)->commit());
  source = open(file_);
  ASSERT_TRUE(source) << source.error().text();
  EXPECT_THAT((*source)->info().format, HasSubstr("OpenEXR"));
  const auto pixels = test::read_all(source);
  ASSERT_TRUE(pixels) << pixels.error().text();
  EXPECT_EQ(pixels->values, std::vector<float>(6, 0.5f));

  test::write_with_oiio(folder_ / "picture.png", OIIO::ImageSpec(2, 1, 3, OIIO::TypeDesc::UINT8),
                        std::vector<std::uint8_t>(6));
  std::filesystem::rename(folder_ / "picture.png", file_);
  source = open(file_);
  ASSERT_TRUE(source) << source.error().text();
  EXPECT_THAT((*source)->info().format, HasSubstr("png"));
}

TEST_F(OpenPanorama, FilesThatAreNotThereOrEmpty) {
  EXPECT_EQ(open(folder_ / "absent.hdr").error().code, ErrorCode::not_found);
  EXPECT_EQ(open(folder_.path()).error().code, ErrorCode::unreadable);
  test::write_bytes(file_, "");
  EXPECT_EQ(open(file_).error().code, ErrorCode::malformed);
  EXPECT_EQ(open(file_).error().where, file_.string());
}

// Too short for any magic number, or nothing but one.
TEST_F(OpenPanorama, StubsOfFiles) {
  for (const std::string bytes : {"#", "#?", "\x76", "\x76\x2f\x31\x01", "P", "\x89PNG", "\n"}) {
    test::write_bytes(file_, bytes);
    const auto source = open(file_);
    ASSERT_FALSE(source) << bytes;
    EXPECT_TRUE(source.error().code == ErrorCode::malformed ||
                source.error().code == ErrorCode::unsupported)
        << source.error().text();
  }
}

// Crashed another reader: a resolution line with a number that runs into rubbish.
TEST_F(OpenPanorama, RadianceFileWithACrashingResolution) {
  SHOAL_REQUIRE_TEST_DATA("bad_inputs/oiio/crash-res.hdr");
  const auto source = open(test::data_folder() / "bad_inputs" / "oiio" / "crash-res.hdr");
  ASSERT_FALSE(source);
  EXPECT_EQ(source.error().code, ErrorCode::malformed) << source.error().text();
}

}  // namespace
}  // namespace shoal
