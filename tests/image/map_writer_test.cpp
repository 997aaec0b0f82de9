// Maps as files: what an independent reader finds in them, the same bytes every time, whole or not
// at all.
#include "image/map_writer.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <half.h>
#include <sys/resource.h>

#include <cmath>
#include <csignal>
#include <limits>

#include "image/oiio_picture.h"
#include "image/panorama_pixels.h"
#include "image/radiance_file.h"
#include "image/radiance_source.h"
#include "support/temporary_folder.h"

namespace shoal {
namespace {

constexpr float kInfinity = std::numeric_limits<float>::infinity();
constexpr float kNan = std::numeric_limits<float>::quiet_NaN();

struct Map {
  int width = 0, height = 0;
  std::array<std::vector<float>, 3> planes;

  [[nodiscard]] float at(int c, std::size_t pixel) const { return planes[c][pixel]; }
  [[nodiscard]] std::size_t pixel_count() const { return planes[0].size(); }
};

class Maps : public ::testing::Test {
 protected:
  // Values over many magnitudes, some negative; long equal stretches too.
  Map random_map(int width, int height) {
    Map map{width, height, {}};
    for (auto& plane : map.planes) {
      while (static_cast<int>(plane.size()) < width * height) {
        const auto value = static_cast<float>(random_.between(-0.1, 1.0) *
                                              std::exp2(random_.between(-20.0, 20.0)));
        plane.push_back(value);
        for (int more = random_.below(3) == 0 ? random_.below(300) : 0;
             more > 0 && static_cast<int>(plane.size()) < width * height; --more) {
          plane.push_back(value);
        }
      }
    }
    return map;
  }

  Status write(const Map& map, const MapFile& file, int rows_at_once = 5) {
    SHOAL_ASSIGN_OR_RETURN(writer, MapWriter::create(path_, file));
    for (int row = 0; row < map.height; row += rows_at_once) {
      const auto offset = static_cast<std::ptrdiff_t>(row) * map.width;
      SHOAL_RETURN_IF_ERROR(
          writer->write_rows({map.planes[0].data() + offset, map.planes[1].data() + offset,
                              map.planes[2].data() + offset},
                             map.width, std::min(rows_at_once, map.height - row)));
    }
    return writer->commit();
  }

  test::OiioPicture written(const Map& map, MapFormat format, MapFile file = {}) {
    path_ = folder_ / (format == MapFormat::hdr   ? "map.hdr"
                       : format == MapFormat::png ? "map.png"
                                                  : "map.exr");
    file.format = format;
    file.width = map.width;
    file.height = map.height;
    const auto status = write(map, file);
    EXPECT_TRUE(status) << status.error().text();
    return test::read_with_oiio(path_);
  }

  [[nodiscard]] int files_in_folder() const {
    return static_cast<int>(std::distance(std::filesystem::directory_iterator(folder_.path()), {}));
  }

  test::TemporaryFolder folder_;
  std::filesystem::path path_ = folder_ / "map.exr";
  test::RandomNumbers random_{5};
};

TEST_F(Maps, ExrFloatIsBitForBit) {
  const Map map = random_map(37, 21);
  const auto picture = written(map, MapFormat::exr_float);
  ASSERT_EQ(picture.spec.width, 37);
  ASSERT_EQ(picture.spec.height, 21);
  EXPECT_EQ(picture.spec.format, OIIO::TypeDesc::FLOAT);
  EXPECT_EQ(picture.spec.get_string_attribute("compression"), "zip");
  EXPECT_THAT(picture.spec.channelnames, ::testing::ElementsAre("R", "G", "B"));
  EXPECT_FALSE(picture.spec.find_attribute("envmap")) << "pixels are at their centres";
  for (std::size_t i = 0; i < map.pixel_count(); ++i) {
    for (int c = 0; c < 3; ++c) ASSERT_EQ(picture.values[3 * i + c], map.at(c, i));
  }
}

TEST_F(Maps, ExrHalfRoundsToNearestAndClamps) {
  Map map = random_map(37, 21);
  const float odd[] = {1e9f, -1e9f, kInfinity, -kInfinity, 65504.0f, 65519.9f, 65520.0f};
  std::copy(std::begin(odd), std::end(odd), map.planes[1].begin());
  const auto picture = written(map, MapFormat::exr_half);
  EXPECT_EQ(picture.spec.format, OIIO::TypeDesc::HALF);
  for (std::size_t i = 0; i < map.pixel_count(); ++i) {
    for (int c = 0; c < 3; ++c) {
      const float expected = half(std::clamp(map.at(c, i), -65504.0f, 65504.0f));
      ASSERT_EQ(picture.values[3 * i + c], expected) << map.at(c, i);
    }
  }
}

// Half a step of the mantissa that the largest component sets: 2^-9 of a power of two above it.
TEST_F(Maps, HdrIsWithinHalfAStepForEveryWidth) {
  std::vector<int> widths = {127, 128, 129, 1000, 32767, 32768};
  for (int width = 1; width <= 40; ++width) widths.push_back(width);
  for (const int width : widths) {
    const Map map = random_map(width, 3);
    const auto picture = written(map, MapFormat::hdr);
    ASSERT_EQ(picture.spec.width, width);
    for (std::size_t i = 0; i < map.pixel_count(); ++i) {
      const float largest = std::max({map.at(0, i), map.at(1, i), map.at(2, i), 0.0f});
      int exponent = 0;
      std::frexp(largest, &exponent);
      // A largest mantissa that rounds up to 256 moves the exponent, and with it the step, by one.
      const bool moves = std::ldexp(largest, 8 - exponent) >= 255.5f;
      const double half_step = std::ldexp(0.5, exponent - 8 + (moves ? 1 : 0));
      for (int c = 0; c < 3; ++c) {
        const float value = std::max(map.at(c, i), 0.0f);
        ASSERT_LE(std::abs(picture.values[3 * i + c] - value), half_step) << value;
      }
    }
    const auto own = test::read_all(open_radiance(path_, {}));
    ASSERT_TRUE(own) << own.error().text();
    EXPECT_TRUE(own->values == picture.values);
  }
}

// encode_rgbe() is the inverse of the decode on everything that a decode can give.
TEST(EncodeRgbe, InvertsTheFloorDecode) {
  test::RandomNumbers random(9);
  for (int e = 1; e < 256; ++e) {
    for (int round = 0; round < 300; ++round) {
      test::Texel texel = test::random_texel(random);
      texel[random.below(3)] |= 128;
      texel[3] = static_cast<std::uint8_t>(e);
      const auto value = [&](int c) { return static_cast<float>(std::ldexp(texel[c], e - 136)); };
      ASSERT_EQ(encode_rgbe(value(0), value(1), value(2)), texel);
    }
  }
}

TEST(EncodeRgbe, EdgesOfItsRange) {
  const test::Texel black = {0, 0, 0, 0}, brightest = {255, 255, 0, 255};
  EXPECT_EQ(encode_rgbe(0.0f, -1.0f, kNan), black);
  EXPECT_EQ(encode_rgbe(0x1p-130f, 0.0f, 0.0f), black);
  EXPECT_EQ(encode_rgbe(kInfinity, std::numeric_limits<float>::max(), -kInfinity), brightest);
  EXPECT_EQ(encode_rgbe(1.0f, 0.5f, 0.25f), (test::Texel{128, 64, 32, 129}));
  // 255.5/256 is a tie between 255 and 256; away from zero is 256, which is 128 of the next
  // exponent.
  EXPECT_EQ(encode_rgbe(255.5f / 256.0f, 0.0f, 0.0f), (test::Texel{128, 0, 0, 129}));
  EXPECT_EQ(encode_rgbe(255.49f / 256.0f, 0.0f, 0.0f), (test::Texel{255, 0, 0, 128}));
}

TEST_F(Maps, PngIsTheCurveOfEachSampleAndSaysItsExposure) {
  const Map map = random_map(30, 17);
  MapFile file;
  file.preview_exposure = -1.5;
  file.attributes = {{"quantity", "irradiance"}};
  const auto picture = written(map, MapFormat::png, file);
  EXPECT_EQ(picture.spec.format, OIIO::TypeDesc::UINT8);
  EXPECT_EQ(picture.spec.get_string_attribute("oiio:ColorSpace"), "sRGB");
  EXPECT_EQ(picture.spec.get_string_attribute("quantity"), "irradiance");
  EXPECT_THAT(std::string(picture.spec.get_string_attribute("Exposure")),
              ::testing::HasSubstr("-1.5 stops"));
  for (std::size_t i = 0; i < map.pixel_count(); ++i) {
    for (int c = 0; c < 3; ++c) {
      ASSERT_EQ(std::lround(picture.values[3 * i + c] * 255.0f),
                preview_sample(map.at(c, i), -1.5));
    }
  }
}

TEST(PreviewSample, BlackWhiteAndBetween) {
  EXPECT_EQ(preview_sample(0.0f, 0.0), 0);
  EXPECT_EQ(preview_sample(-5.0f, 0.0), 0);
  EXPECT_EQ(preview_sample(kNan, 0.0), 0);
  EXPECT_EQ(preview_sample(kInfinity, -100.0), 255);
  EXPECT_EQ(preview_sample(100.0f, 0.0), 255);
  // x = ln 2 is half of white in linear light, which sRGB codes as 188.
  EXPECT_EQ(preview_sample(static_cast<float>(std::log(2.0)), 0.0), 188);
  for (float value = 0.01f; value < 4.0f; value += 0.01f) {
    EXPECT_EQ(preview_sample(value, 1.0), preview_sample(2.0f * value, 0.0))
        << "a stop is a factor 2";
    EXPECT_LE(preview_sample(value, 0.0), preview_sample(value + 0.01f, 0.0));
  }
}

TEST_F(Maps, AttributesAreFoundInTheFile) {
  MapFile file;
  file.attributes = {{"shoal:quantity", "irradiance over pi"}, {"frame", "{center: -x}"}};
  const Map map = random_map(4, 2);
  const auto exr = written(map, MapFormat::exr_half, file);
  EXPECT_EQ(exr.spec.get_string_attribute("shoal:quantity"), "irradiance over pi");
  EXPECT_EQ(exr.spec.get_string_attribute("frame"), "{center: -x}");
  written(map, MapFormat::hdr, file);
  EXPECT_THAT(test::read_bytes(path_), ::testing::HasSubstr("# frame: {center: -x}\n"));
}

TEST_F(Maps, SameMapSameBytes) {
  const Map map = random_map(64, 33);
  for (const auto format :
       {MapFormat::exr_half, MapFormat::exr_float, MapFormat::hdr, MapFormat::png}) {
    const MapFile file{format, map.width, map.height, 0.25, {{"name", "a panorama"}}};
    ASSERT_TRUE(write(map, file, 5));
    const std::string first = test::read_bytes(path_);
    for (const int rows_at_once : {1, 16, 33}) {
      ASSERT_TRUE(write(map, file, rows_at_once));
      EXPECT_TRUE(test::read_bytes(path_) == first) << rows_at_once << " rows at once";
    }
  }
}

TEST_F(Maps, AppearWholeOrNotAtAll) {
  const Map map = random_map(16, 4);
  const std::array<const float*, 3> planes = {map.planes[0].data(), map.planes[1].data(),
                                              map.planes[2].data()};
  for (const auto format :
       {MapFormat::exr_half, MapFormat::exr_float, MapFormat::hdr, MapFormat::png}) {
    path_ = folder_ / ("folder/" + std::to_string(static_cast<int>(format)));
    const MapFile file{format, map.width, map.height, 0.0, {}};
    {
      auto writer = MapWriter::create(path_, file);
      ASSERT_TRUE(writer) << writer.error().text();
      ASSERT_TRUE((*writer)->write_rows(planes, map.width, 3));
      EXPECT_FALSE(std::filesystem::exists(path_)) << "before commit()";
      EXPECT_EQ((*writer)->commit().error().code, ErrorCode::internal) << "a row is missing";
      EXPECT_EQ((*writer)->write_rows(planes, map.width, 2).error().code, ErrorCode::internal);
    }
    EXPECT_TRUE(std::filesystem::is_empty(folder_ / "folder"))
        << "nothing stays of an abandoned map";
    ASSERT_TRUE(write(map, file));
    EXPECT_TRUE(std::filesystem::exists(path_));
    std::filesystem::remove(path_);
  }
}

TEST_F(Maps, WhatNoFileCanHold) {
  for (const auto format : {MapFormat::exr_half, MapFormat::hdr, MapFormat::png}) {
    const auto code = [&](const MapFile& file) {
      const auto writer = MapWriter::create(path_, file);
      return writer ? ErrorCode::internal : writer.error().code;
    };
    EXPECT_EQ(code({format, 0, 1, 0.0, {}}), ErrorCode::usage);
    EXPECT_EQ(code({format, 1, 1 << 20, 0.0, {}}), ErrorCode::usage);
    EXPECT_EQ(code({format, 1, 1, kNan, {}}), ErrorCode::usage);
    EXPECT_EQ(code({format, 1, 1, 0.0, {{"", "no name"}}}), ErrorCode::usage);
    EXPECT_EQ(code({format, 1, 1, 0.0, {{"two words", ""}}}), ErrorCode::usage);
    EXPECT_EQ(code({format, 1, 1, 0.0, {{"name", "two\nlines"}}}), ErrorCode::usage);
    if (format != MapFormat::exr_half) {
      EXPECT_EQ(code({format, 1, 1, 0.0, {}, MapFile::Environment::cube}), ErrorCode::usage);
    }
  }
  EXPECT_EQ(files_in_folder(), 0);
}

TEST_F(Maps, AFolderThatCannotBeMadeIsAnError) {
  test::write_bytes(folder_ / "file", "");
  path_ = folder_ / "file" / "map.exr";  // below something that is no folder
  const auto status = write(random_map(8, 8), {MapFormat::exr_float, 8, 8, 0.0, {}});
  ASSERT_FALSE(status);
  EXPECT_EQ(status.error().code, ErrorCode::write_failed);
}

// No write beyond so many bytes succeeds while this lives, as on a full disc.
class FullDisc {
 public:
  explicit FullDisc(rlim_t room) {
    ::getrlimit(RLIMIT_FSIZE, &before_);
    handler_ = std::signal(SIGXFSZ, SIG_IGN);
    const rlimit limit{room, before_.rlim_max};
    ::setrlimit(RLIMIT_FSIZE, &limit);
  }
  ~FullDisc() {
    ::setrlimit(RLIMIT_FSIZE, &before_);
    std::signal(SIGXFSZ, handler_);
  }
  FullDisc(const FullDisc&) = delete;
  FullDisc& operator=(const FullDisc&) = delete;

 private:
  rlimit before_{};
  void (*handler_)(int) = nullptr;
};

// Wherever the room ends, in the header, the rows or what comes behind them: write_failed, and
// nothing is left.
TEST_F(Maps, AFullDiscIsAnErrorWhereverItEnds) {
  const Map map = random_map(40, 40);
  for (const auto format : {MapFormat::exr_float, MapFormat::hdr, MapFormat::png}) {
    const MapFile file{format, map.width, map.height, 0.0, {}};
    ASSERT_TRUE(write(map, file));
    const auto whole = std::filesystem::file_size(path_);
    std::filesystem::remove(path_);
    for (const auto room : {std::uintmax_t{0}, std::uintmax_t{10}, whole / 2, whole - 1}) {
      const auto status = [&] {
        const FullDisc disc(room);
        return write(map, file);
      }();
      ASSERT_FALSE(status) << room << " of " << whole;
      EXPECT_EQ(status.error().code, ErrorCode::write_failed) << status.error().text();
      EXPECT_THAT(status.error().what, ::testing::HasSubstr("File too large"));
      EXPECT_EQ(files_in_folder(), 0);
    }
  }
}

}  // namespace
}  // namespace shoal
