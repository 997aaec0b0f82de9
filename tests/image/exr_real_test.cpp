// Real EXR files against OpenImageIO and against the expected decodes that come with them.
#include <ImfRgbaFile.h>
#include <gtest/gtest.h>

#include <bit>
#include <map>

#include "image/exr_file.h"
#include "image/oiio_picture.h"
#include "image/panorama_pixels.h"
#include "support/test_data.h"

namespace shoal::test {
namespace {

// Files that are refused, and as what. All others must be read.
const std::map<std::string, ErrorCode> kRefused = {
    {"openexr-images/TestImages/WideFloatRange.exr", ErrorCode::unsupported},  // G only
    {"openexr-testsuite/v1.7.test.interleaved.exr", ErrorCode::unsupported},   // R and Z
    {"openexr-testsuite/v1.7.test.tiled.exr", ErrorCode::unsupported},         // G and Z
    {"openexr-testsuite/deep/11.deep.exr", ErrorCode::unsupported},
    {"openexr-testsuite/comp_bad_neg_bounds_pxr24.exr", ErrorCode::malformed},
    {"openexr-testsuite/comp_early_eof_piz.exr", ErrorCode::malformed},
    {"openexr-testsuite/invalid.exr", ErrorCode::malformed},
    {"bad_inputs/tinyexr/flaga.exr", ErrorCode::unsupported},  // layers only
    {"oiio/partial.exr", ErrorCode::malformed},                // tiles that were never written
};

// Luminance/chroma, which OpenImageIO does not read.
bool is_luminance_chroma(const std::string& name) {
  return name == "openexr-images/Chromaticities/Rec709_YC.exr";
}

bool same_number(float a, float b) {
  return std::bit_cast<std::uint32_t>(a) == std::bit_cast<std::uint32_t>(b) ||
         (std::isnan(a) && std::isnan(b));
}

// OpenImageIO's channel `name`, placed where the picture has it, black elsewhere.
std::vector<float> plane_of(const OiioPicture& oiio, const std::string& name,
                            const PictureInfo& info) {
  const OIIO::ImageSpec& spec = oiio.spec;
  const bool is_map = info.positions == PixelPositions::endpoints;
  const int left = spec.x - (is_map ? spec.x : spec.full_x);
  const int top = spec.y - (is_map ? spec.y : spec.full_y);
  const int channel = spec.channelindex(name);
  std::vector<float> plane(static_cast<std::size_t>(info.width) * info.height);
  for (int y = 0; y < spec.height; ++y) {
    for (int x = 0; x < spec.width; ++x) {
      const int row = top + y;
      const int column = left + x;
      if (row < 0 || row >= info.height || column < 0 || column >= info.width) continue;
      plane[static_cast<std::size_t>(row) * info.width + column] =
          oiio.values[(static_cast<std::size_t>(y) * spec.width + x) * spec.nchannels + channel];
    }
  }
  return plane;
}

void compare_with_oiio(const std::filesystem::path& path, const PanoramaSource& source,
                       const PanoramaPixels& pixels) {
  const OiioPicture oiio = read_with_oiio(path);
  const std::vector<std::string> names = pixels.channel_count == 1
                                             ? std::vector<std::string>{"Y"}
                                             : std::vector<std::string>{"R", "G", "B"};
  for (int c = 0; c < pixels.channel_count; ++c) {
    const std::vector<float> expected = plane_of(oiio, names[c], source.info());
    std::size_t different = 0;
    for (std::size_t i = 0; i < expected.size(); ++i) {
      if (!same_number(expected[i], pixels.values[i * pixels.channel_count + c])) ++different;
    }
    EXPECT_EQ(different, 0u) << path << " " << names[c];
  }
}

void compare_with_rgba_file(const std::filesystem::path& path, const PanoramaPixels& pixels) {
  Imf::RgbaInputFile file(path.c_str(), 0);
  const Imath::Box2i window = file.dataWindow();
  ASSERT_EQ(window, file.displayWindow());
  std::vector<Imf::Rgba> expected(static_cast<std::size_t>(pixels.width) * pixels.height);
  file.setFrameBuffer(expected.data() - window.min.x - window.min.y * pixels.width, 1,
                      pixels.width);
  file.readPixels(window.min.y, window.max.y);
  for (std::size_t i = 0; i < expected.size(); ++i) {
    ASSERT_TRUE(same_number(pixels.values[3 * i], expected[i].r));
    ASSERT_TRUE(same_number(pixels.values[3 * i + 1], expected[i].g));
    ASSERT_TRUE(same_number(pixels.values[3 * i + 2], expected[i].b));
  }
}

class ExrRealFiles : public testing::TestWithParam<const char*> {};

TEST_P(ExrRealFiles, PixelsAreOpenImageIOs) {
  SHOAL_REQUIRE_TEST_DATA(GetParam());
  int read = 0;
  for (const auto& entry :
       std::filesystem::recursive_directory_iterator(data_folder() / GetParam())) {
    if (entry.path().extension() != ".exr") continue;
    const std::string name = entry.path().lexically_relative(data_folder()).generic_string();
    const auto source = open_exr(entry.path(), {}, portable_chunk_codecs());
    const auto pixels = read_all(source);
    if (const auto refused = kRefused.find(name); refused != kRefused.end()) {
      ASSERT_FALSE(pixels) << name;
      EXPECT_EQ(pixels.error().code, refused->second) << pixels.error().text();
      continue;
    }
    ASSERT_TRUE(pixels) << pixels.error().text();
    ++read;
    if (is_luminance_chroma(name)) {
      compare_with_rgba_file(entry.path(), *pixels);
    } else {
      compare_with_oiio(entry.path(), **source, *pixels);
    }
  }
  EXPECT_GT(read, 0);
}

INSTANTIATE_TEST_SUITE_P(
    Folders, ExrRealFiles,
    testing::Values("pmndrs_exr", "blender_exr", "polyhaven_exr", "exrs", "openexr-testsuite",
                    "oiio", "bad_inputs", "openexr-images/ScanLines",
                    "openexr-images/Chromaticities", "openexr-images/LuminanceChroma",
                    "openexr-images/MultiResolution", "openexr-images/DisplayWindow",
                    "openexr-images/Beachball", "openexr-images/TestImages"),
    [](const auto& parameter) {
      std::string name = parameter.param;
      for (char& c : name) c = std::isalnum(static_cast<unsigned char>(c)) ? c : '_';
      return name;
    });

constexpr const char* kMethods = "exrs/valid/custom/compression_methods";

RawPicture decode(const std::filesystem::path& path) {
  const auto picture = read_raw(path);
  EXPECT_TRUE(picture) << picture.error().text();
  return picture ? *picture : RawPicture{};
}

TEST(ExrExpectedDecodes, LossyCodecsDecodeAsExpected) {
  SHOAL_REQUIRE_TEST_DATA(kMethods);
  const auto folder = data_folder() / kMethods;
  for (const char* name : {"f16/b44", "f16/b44a", "f16/pxr24", "f32/pxr24"}) {
    const std::filesystem::path file = folder / (std::string(name) + ".exr");
    const auto expected = file.parent_path() / ("decompressed_" + file.filename().string());
    EXPECT_TRUE(decode(file) == decode(expected)) << name;
  }
}

// DWA is no bit-exact format: its cosine transform is computed in floats, in an order that depends
// on the library's version and processor. So most pixels agree, and none is farther off than the
// codec's own loss on this picture, which is 2 %.
TEST(ExrExpectedDecodes, DwaDecodesAsExpectedButForRounding) {
  SHOAL_REQUIRE_TEST_DATA(kMethods);
  const auto folder = data_folder() / kMethods;
  for (const char* name : {"f16/dwaa", "f16/dwab", "f32/dwaa", "f32/dwab"}) {
    const std::filesystem::path file = folder / (std::string(name) + ".exr");
    const auto expected_file = file.parent_path() / ("decompressed_" + file.filename().string());
    const auto pixels = read_all(open_exr(file, {}, portable_chunk_codecs()));
    const auto expected = read_all(open_exr(expected_file, {}, portable_chunk_codecs()));
    ASSERT_TRUE(pixels && expected);
    ASSERT_EQ(pixels->values.size(), expected->values.size());
    std::size_t different = 0;
    for (std::size_t i = 0; i < pixels->values.size(); ++i) {
      const float value = expected->values[i];
      if (!same_number(pixels->values[i], value)) ++different;
      ASSERT_NEAR(pixels->values[i], value, 0.02f * std::abs(value)) << name << " sample " << i;
    }
    EXPECT_LT(different, pixels->values.size() / 20) << name;
  }
}

TEST(ExrExpectedDecodes, LosslessCodecsDecodeAlike) {
  SHOAL_REQUIRE_TEST_DATA(kMethods);
  for (const char* type : {"f16", "f32"}) {
    const auto folder = data_folder() / kMethods / type;
    const RawPicture expected = decode(folder / "uncompressed.exr");
    for (const char* name : {"rle.exr", "zip.exr", "zips.exr", "piz.exr"}) {
      EXPECT_TRUE(decode(folder / name) == expected) << type << " " << name;
    }
  }
}

TEST(ExrExpectedDecodes, LineOrderDoesNotMatter) {
  SHOAL_REQUIRE_TEST_DATA("openexr-testsuite");
  const auto folder = data_folder() / "openexr-testsuite";
  EXPECT_TRUE(decode(folder / "lineOrder_decreasing.exr") ==
              decode(folder / "lineOrder_increasing.exr"));
}

TEST(ExrExpectedDecodes, LayersOfARealFile) {
  SHOAL_REQUIRE_TEST_DATA("bad_inputs/tinyexr/flaga.exr");
  const auto path = data_folder() / "bad_inputs/tinyexr/flaga.exr";
  ReadOptions options;
  options.layer = "Warstwa 2";
  const auto picture = read_raw(path, options);
  ASSERT_TRUE(picture) << picture.error().text();
  EXPECT_TRUE(*picture == read_with_imf(path, {"Warstwa 2.R", "Warstwa 2.G", "Warstwa 2.B"}));
}

}  // namespace
}  // namespace shoal::test
