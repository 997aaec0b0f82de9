// The formats that are left to OpenImageIO, through the module that is loaded on demand.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <fstream>
#include <string>

#include "image/map_writer.h"
#include "image/module_loader.h"
#include "image/module_source.h"
#include "image/oiio_picture.h"
#include "image/panorama_pixels.h"
#include "image/radiance_file.h"
#include "support/temporary_folder.h"

namespace shoal {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

// IEC 61966-2-1, written down once more, in more precision.
float linearised(long double encoded) {
  if (encoded <= 0.04045L) return static_cast<float>(encoded / 12.92L);
  return static_cast<float>(std::pow((encoded + 0.055L) / 1.055L, 2.4L));
}

// The same to a unit in the last place of a float, which double against long double may cost.
void expect_equal(const std::vector<float>& actual, const std::vector<float>& expected) {
  ASSERT_EQ(actual.size(), expected.size());
  for (std::size_t i = 0; i < actual.size(); ++i) {
    ASSERT_FLOAT_EQ(actual[i], expected[i]) << "sample " << i;
  }
}

// "PF", the size, a scale whose sign tells the byte order; rows from the bottom up.
void write_pfm(const std::filesystem::path& path, int width, int height,
               const std::vector<float>& values) {
  std::string bytes = "PF\n" + std::to_string(width) + ' ' + std::to_string(height) + "\n-1.0\n";
  for (int y = height - 1; y >= 0; --y) {
    const float* row = values.data() + static_cast<std::ptrdiff_t>(y) * width * 3;
    bytes.append(reinterpret_cast<const char*>(row), sizeof(float) * width * 3);
  }
  test::write_bytes(path, bytes);
}

class Module : public ::testing::Test {
 protected:
  void SetUp() override { ::setenv("SHOAL_MODULE_PATH", SHOAL_TEST_MODULE_FOLDER, 1); }

  Result<test::PanoramaPixels> read(const std::filesystem::path& path,
                                    Encoding encoding = Encoding::srgb, int rows_per_band = 0) {
    ReadOptions options;
    options.encoding = encoding;
    options.rows_per_band = rows_per_band;
    return test::read_all(open_with_module(path, options));
  }

  // Every value that a sample of type T can have, in a square picture with three channels.
  template <typename T>
  void expect_every_level(const std::string& name, int side) {
    const auto file = folder_ / name;
    OIIO::ImageSpec spec(side, side, 3, OIIO::BaseTypeFromC<T>::value);
    std::vector<T> samples;
    std::vector<float> as_srgb, as_linear;
    for (int i = 0; i < side * side; ++i) {
      for (const int shift : {0, 5, 77}) {
        const auto level = static_cast<T>(i + shift);
        constexpr int kLargest = std::numeric_limits<T>::max();
        samples.push_back(level);
        as_srgb.push_back(linearised(level / static_cast<long double>(kLargest)));
        as_linear.push_back(static_cast<float>(level / static_cast<double>(kLargest)));
      }
    }
    test::write_with_oiio(file, spec, samples);
    const auto srgb = read(file), linear = read(file, Encoding::linear);
    ASSERT_TRUE(srgb) << srgb.error().text();
    ASSERT_TRUE(linear) << linear.error().text();
    expect_equal(srgb->values, as_srgb);
    expect_equal(linear->values, as_linear);
  }

  std::vector<float> random_floats(std::size_t count) {
    std::vector<float> values(count);
    for (float& value : values) value = static_cast<float>(random_.between(-1.0, 1e5));
    return values;
  }

  test::TemporaryFolder folder_;
  test::RandomNumbers random_{3};
};

TEST_F(Module, IntegersAreLinearisedUnlessToldOtherwise) {
  expect_every_level<std::uint8_t>("eight.png", 16);
  expect_every_level<std::uint16_t>("sixteen.png", 256);
}

TEST_F(Module, FloatsComeBitForBitInAnyBands) {
  constexpr int kWidth = 67, kHeight = 41;
  for (const std::string name : {"scanlines.tif", "tiles.tif", "picture.pfm"}) {
    const auto file = folder_ / name;
    const auto values = random_floats(std::size_t{kWidth} * kHeight * 3);
    OIIO::ImageSpec spec(kWidth, kHeight, 3, OIIO::TypeDesc::FLOAT);
    if (name == "tiles.tif") spec.tile_width = spec.tile_height = 16;
    if (name == "picture.pfm") {
      write_pfm(file, kWidth, kHeight, values);
    } else {
      test::write_with_oiio(file, spec, values);
    }
    for (const int rows_per_band : {0, 1, 7, 40, 1000}) {
      for (const auto encoding : {Encoding::srgb, Encoding::linear}) {
        const auto pixels = read(file, encoding, rows_per_band);
        ASSERT_TRUE(pixels) << pixels.error().text();
        EXPECT_EQ(pixels->width, kWidth);
        EXPECT_EQ(pixels->height, kHeight);
        EXPECT_TRUE(pixels->values == values) << name << " in bands of " << rows_per_band;
      }
    }
  }
}

// JPEG loses something when written, so the same decoder's integers are what counts.
TEST_F(Module, Jpeg) {
  const auto file = folder_ / "picture.jpg";
  OIIO::ImageSpec spec(40, 20, 3, OIIO::TypeDesc::UINT8);
  std::vector<std::uint8_t> samples(spec.image_pixels() * 3);
  for (std::size_t i = 0; i < samples.size(); ++i) samples[i] = static_cast<std::uint8_t>(i / 10);
  test::write_with_oiio(file, spec, samples);
  const auto pixels = read(file);
  ASSERT_TRUE(pixels) << pixels.error().text();
  std::vector<float> expected;
  for (const float value : test::read_with_oiio(file).values) {
    expected.push_back(linearised(std::lround(value * 255.0f) / 255.0L));
  }
  expect_equal(pixels->values, expected);
}

TEST_F(Module, GreyIsOneChannelAndAlphaIsIgnored) {
  for (const int channel_count : {1, 2, 4}) {
    const auto file = folder_ / ("channels" + std::to_string(channel_count) + ".png");
    OIIO::ImageSpec spec(9, 3, channel_count, OIIO::TypeDesc::UINT8);
    spec.attribute("oiio:UnassociatedAlpha", 1);  // what follows is not multiplied by alpha
    std::vector<std::uint8_t> samples;
    std::vector<float> expected;
    for (int pixel = 0; pixel < 27; ++pixel) {
      for (int c = 0; c < channel_count; ++c) {
        const bool is_alpha = channel_count != 1 && c == channel_count - 1;
        samples.push_back(static_cast<std::uint8_t>(is_alpha ? pixel : 200 - pixel - 9 * c));
        if (!is_alpha) expected.push_back(linearised(samples.back() / 255.0L));
      }
    }
    test::write_with_oiio(file, spec, samples);
    const auto pixels = read(file);
    ASSERT_TRUE(pixels) << pixels.error().text();
    EXPECT_EQ(pixels->channel_count, channel_count == 4 ? 3 : 1);
    expect_equal(pixels->values, expected);
  }
}

TEST_F(Module, WhatTheFileSaysButIsNotFollowedIsAWarning) {
  const auto warnings = [&](const std::string& key, auto value, int full_width) {
    OIIO::ImageSpec spec(2, 1, 3, OIIO::TypeDesc::UINT8);
    spec.attribute(key, value);
    spec.full_width = full_width;
    const auto file = folder_ / "picture.tif";
    test::write_with_oiio(file, spec, std::vector<std::uint8_t>(6));
    const auto source = open_with_module(file, {});
    return source ? (*source)->info().warnings : std::vector<std::string>{source.error().text()};
  };
  EXPECT_THAT(warnings("Orientation", 1, 2), IsEmpty());
  EXPECT_THAT(warnings("Orientation", 6, 2), ElementsAre(HasSubstr("orientation 6")));
  EXPECT_THAT(warnings("Orientation", 1, 5), ElementsAre(HasSubstr("not the whole frame")));

  const auto png = folder_ / "linear.png";
  OIIO::ImageSpec spec(2, 1, 3, OIIO::TypeDesc::UINT8);
  spec.attribute("oiio:ColorSpace", "Linear");
  test::write_with_oiio(png, spec, std::vector<std::uint8_t>(6));
  ReadOptions options;
  EXPECT_THAT((*open_with_module(png, options))->info().warnings,
              ElementsAre(HasSubstr("taken as sRGB")));
  options.encoding = Encoding::linear;
  EXPECT_THAT((*open_with_module(png, options))->info().warnings, IsEmpty());
}

TEST_F(Module, FilesThatAreNoPictures) {
  const auto text = folder_ / "notes.txt", cut_off = folder_ / "cut.png";
  test::write_bytes(text, "no picture at all\n");
  const auto no_picture = read(text);
  ASSERT_FALSE(no_picture);
  EXPECT_EQ(no_picture.error().code, ErrorCode::unsupported) << no_picture.error().text();
  EXPECT_EQ(no_picture.error().where, text.string());
  EXPECT_EQ(no_picture.error().what.find('\n'), std::string::npos) << "one line";

  OIIO::ImageSpec spec(64, 64, 3, OIIO::TypeDesc::UINT8);
  std::vector<std::uint8_t> noise(spec.image_pixels() * 3);
  for (auto& sample : noise) sample = static_cast<std::uint8_t>(random_.below(256));
  test::write_with_oiio(cut_off, spec, noise);
  const std::string whole = test::read_bytes(cut_off);
  for (const std::size_t size : {std::size_t{20}, whole.size() / 2}) {
    test::write_bytes(cut_off, whole.substr(0, size));
    const auto pixels = read(cut_off);
    ASSERT_FALSE(pixels) << size;
    EXPECT_EQ(pixels.error().code, ErrorCode::malformed) << pixels.error().text();
  }
  EXPECT_EQ(read(folder_ / "absent.png").error().code, ErrorCode::not_found);
  EXPECT_EQ(read(folder_.path()).error().code, ErrorCode::unreadable);
}

bool module_is_mapped() {
  std::ifstream maps("/proc/self/maps");
  const std::string all{std::istreambuf_iterator<char>(maps), {}};
  return all.find("shoal_oiio.so") != std::string::npos;
}

class ModuleLoading : public Module {
 protected:
  void SetUp() override {
    Module::SetUp();
    // Each death test runs in a process of its own, in which nothing was loaded before.
    GTEST_FLAG_SET(death_test_style, "threadsafe");
    test::write_with_oiio(png_, OIIO::ImageSpec(2, 1, 3, OIIO::TypeDesc::UINT8),
                          std::vector<std::uint8_t>(6));
    test::write_bytes(hdr_, test::radiance_header("-Y 1 +X 1") + "\x80\x80\x80\x80");
  }

  std::filesystem::path png_ = folder_ / "picture.png", hdr_ = folder_ / "picture.hdr";
};

TEST_F(ModuleLoading, OnlyWhenAFileNeedsIt) {
  const auto steps = [&] {
    const auto codecs = portable_chunk_codecs();
    if (module_is_mapped()) std::exit(1);
    if (!open_panorama(hdr_, {}, codecs) || module_is_mapped()) std::exit(2);
    if (!open_panorama(png_, {}, codecs) || !module_is_mapped()) std::exit(3);
    std::exit(0);
  };
  EXPECT_EXIT(steps(), ::testing::ExitedWithCode(0), "");
}

TEST_F(ModuleLoading, AbsenceIsToldAndHarmsNothingElse) {
  ::setenv("SHOAL_MODULE_PATH", folder_.path().c_str(), 1);
  const auto steps = [&] {
    const auto codecs = portable_chunk_codecs();
    const auto error = open_panorama(png_, {}, codecs).error();
    std::fprintf(stderr, "%s", error.text().c_str());
    std::exit(error.code == ErrorCode::unsupported && open_panorama(hdr_, {}, codecs) ? 0 : 1);
  };
  EXPECT_EXIT(steps(), ::testing::ExitedWithCode(0), "picture.png: .*module shoal_oiio.so.*not in");
}

// OpenEXR maps are written by a module, too.
TEST_F(ModuleLoading, AbsenceOfTheOneForExrIsToldAndHarmsNoOtherMap) {
  ::setenv("SHOAL_MODULE_PATH", folder_.path().c_str(), 1);
  const auto steps = [&] {
    const auto exr = folder_ / "map.exr", hdr = folder_ / "map.hdr";
    const auto error = MapWriter::create(exr, {MapFormat::exr_half, 2, 1, 0.0, {}}).error();
    std::fprintf(stderr, "%s", error.text().c_str());
    const bool harmless = !std::filesystem::exists(exr) &&
                          MapWriter::create(hdr, {MapFormat::hdr, 2, 1, 0.0, {}}).ok();
    std::exit(error.code == ErrorCode::unsupported && harmless ? 0 : 1);
  };
  EXPECT_EXIT(steps(), ::testing::ExitedWithCode(0), "map.exr: .*module shoal_exr.so.*not in");
}

TEST_F(ModuleLoading, SomethingElseUnderItsNameIsRefused) {
  test::write_bytes(folder_ / "shoal_oiio.so", "not a shared object");
  ::setenv("SHOAL_MODULE_PATH", folder_.path().c_str(), 1);
  const auto steps = [&] {
    const auto error = open_with_module(png_, {}).error();
    std::fprintf(stderr, "%s", error.text().c_str());
    std::exit(error.code == ErrorCode::unsupported ? 0 : 1);
  };
  EXPECT_EXIT(steps(), ::testing::ExitedWithCode(0), "does not load");
}

TEST_F(ModuleLoading, SearchPath) {
  ::setenv("SHOAL_MODULE_PATH", "/first::/second:", 1);
  const auto folders = module_search_path();
  ASSERT_EQ(folders.size(), 4u);
  EXPECT_EQ(folders[0], "/first");
  EXPECT_EQ(folders[1], "/second");
  EXPECT_EQ(folders[2], std::filesystem::read_symlink("/proc/self/exe").parent_path());
  EXPECT_THAT(folders[3].string(), ::testing::EndsWith("/shoal"));
}

// Six faces of 2 x 2 texels, B G R A: a strip with +x on top, and told as such.
TEST_F(Module, DdsCubeMapsAreStrips) {
  constexpr int kEdge = 2;
  std::string bytes = "DDS ";
  const auto add = [&](std::initializer_list<std::uint32_t> words) {
    for (const std::uint32_t word : words) {
      for (int k = 0; k < 4; ++k) bytes += static_cast<char>(word >> (8 * k) & 0xff);
    }
  };
  add({124, 0x100f, kEdge, kEdge, 4 * kEdge, 0, 0});
  bytes.append(44, '\0');
  add({32, 0x41, 0, 32, 0xff0000, 0xff00, 0xff, 0xff000000, 0x1008, 0xfe00, 0, 0, 0});
  for (int face = 0; face < 6; ++face) {
    for (int texel = 0; texel < kEdge * kEdge; ++texel) {
      const auto blue = static_cast<char>(40 * face);
      bytes += {blue, '\0', static_cast<char>(texel), '\xff'};
    }
  }
  const test::TemporaryFolder folder;
  test::write_bytes(folder / "cube.dds", bytes);
  ReadOptions options;
  options.encoding = Encoding::linear;
  const auto source = open_with_module(folder / "cube.dds", options);
  ASSERT_TRUE(source) << source.error().text();
  EXPECT_EQ((*source)->info().environment, EnvironmentMap::cube_strip);
  EXPECT_TRUE((*source)->info().warnings.empty());
  const auto pixels = test::read_all(**source);
  ASSERT_TRUE(pixels) << pixels.error().text();
  ASSERT_EQ(pixels->width, kEdge);
  ASSERT_EQ(pixels->height, 6 * kEdge);
  for (int i = 0; i < 6 * kEdge * kEdge; ++i) {
    EXPECT_FLOAT_EQ(pixels->values[3 * i], static_cast<float>(i % 4) / 255.0F);
    EXPECT_FLOAT_EQ(pixels->values[3 * i + 2], static_cast<float>(40 * (i / 4)) / 255.0F);
  }
}

}  // namespace
}  // namespace shoal
