// Radiance files as OpenImageIO, an independent decoder, reads them.
#include <gtest/gtest.h>

#include "image/oiio_picture.h"
#include "image/panorama_pixels.h"
#include "image/radiance_file.h"
#include "image/radiance_source.h"
#include "support/temporary_folder.h"
#include "support/test_data.h"

namespace shoal {
namespace {

using test::RowCoding;
using test::Scanline;
using test::Texel;

void expect_as_oiio(const std::filesystem::path& path) {
  const auto pixels = test::read_all(open_radiance(path, {}));
  ASSERT_TRUE(pixels) << pixels.error().text();
  const auto oracle = test::read_with_oiio(path);
  ASSERT_EQ(pixels->width, oracle.spec.width);
  ASSERT_EQ(pixels->height, oracle.spec.height);
  EXPECT_TRUE(pixels->values == oracle.values) << path;
}

// OpenImageIO, which decodes m/256 * 2^(e-128) too, sees bit for bit the same pixels. (Its powers
// of two are off by a unit in the last place for e = 40, 223 and 226, so these do not occur here.)
TEST(RadianceFiles, MadeFilesAsOpenImageIoReadsThem) {
  const test::TemporaryFolder folder;
  const auto file = folder / "picture.hdr";
  test::RandomNumbers random(7);
  for (const auto coding : {RowCoding::flat, RowCoding::new_rle}) {
    std::string bytes = test::radiance_header(test::usual_resolution(300, 20));
    for (int y = 0; y < 20; ++y) {
      Scanline row = test::random_scanline(random, 300);
      for (Texel& texel : row) {
        if (texel[3] != 0) texel[3] = static_cast<std::uint8_t>(64 + texel[3] % 128);
      }
      bytes += test::coded_row(row, coding);
    }
    test::write_bytes(file, bytes);
    expect_as_oiio(file);
  }
}

TEST(RadianceFiles, AsOpenImageIoReadsThem) {
  SHOAL_REQUIRE_TEST_DATA("pmndrs_hdr");
  SHOAL_REQUIRE_TEST_DATA("polyhaven_hdr");
  int count = 0;
  for (const auto* folder : {"pmndrs_hdr", "polyhaven_hdr", "rgbe_variants"}) {
    for (const auto& entry : std::filesystem::directory_iterator(test::data_folder() / folder)) {
      if (entry.path().filename() == "imagers_old-rle.hdr") continue;  // OpenImageIO fails on it
      expect_as_oiio(entry.path());
      ++count;
    }
  }
  EXPECT_GE(count, 15);
}

}  // namespace
}  // namespace shoal
