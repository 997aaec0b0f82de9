// Every way in which an EXR file can store a picture, one by one: what comes out of the reader
// equals, byte for byte, what OpenEXR's C++ classes decode from the whole file.
#include <gtest/gtest.h>

#include "image/exr_file.h"
#include "support/temporary_folder.h"

namespace shoal::test {
namespace {

constexpr std::array kCompressions = {
    Imf::NO_COMPRESSION,   Imf::RLE_COMPRESSION,   Imf::ZIPS_COMPRESSION, Imf::ZIP_COMPRESSION,
    Imf::PIZ_COMPRESSION,  Imf::PXR24_COMPRESSION, Imf::B44_COMPRESSION,  Imf::B44A_COMPRESSION,
    Imf::DWAA_COMPRESSION, Imf::DWAB_COMPRESSION};

// Reads the file that `recipe` makes, and compares.
void expect_same_as_imf(const std::filesystem::path& path, const ExrRecipe& recipe,
                        const ReadOptions& options = {}) {
  write_exr(path, recipe);
  const RawPicture expected = read_with_imf(path, {"R", "G", "B"});
  const auto picture = read_raw(path, options);
  ASSERT_TRUE(picture) << picture.error().text();
  EXPECT_EQ(picture->types, expected.types);
  EXPECT_TRUE(*picture == expected)
      << "compression " << recipe.compression << " type " << static_cast<int>(recipe.types[0])
      << " order " << recipe.line_order << " tiles " << recipe.tile_width << " x "
      << recipe.tile_height << " levels " << recipe.levels << " data " << recipe.data.min.x << ","
      << recipe.data.min.y << ".." << recipe.data.max.x << "," << recipe.data.max.y;
}

class ExrCompression : public testing::TestWithParam<Imf::Compression> {
 protected:
  TemporaryFolder folder_;
  const std::filesystem::path path_ = folder_ / "made.exr";
};

// 33 x 70 pixels: an odd width, several chunks of 16 and 32 lines and a rest.
const Imath::Box2i kDisplay{{0, 0}, {32, 69}};
const std::array kDataWindows = {
    Imath::Box2i{{0, 0}, {32, 69}},       // the picture
    Imath::Box2i{{5, 9}, {20, 50}},       // inside
    Imath::Box2i{{-7, -19}, {40, 90}},    // outside
    Imath::Box2i{{-9, 13}, {12, 100}},    // to the lower left
    Imath::Box2i{{11, -37}, {60, 30}},    // to the upper right
    Imath::Box2i{{0, 20}, {32, 40}},      // full width, rows missing
    Imath::Box2i{{100, 200}, {120, 210}}  // somewhere else: all black
};

TEST_P(ExrCompression, ScanlinesOfEveryTypeOrderAndWindow) {
  for (const SampleType type : {SampleType::half, SampleType::float32, SampleType::uint32}) {
    for (const Imf::LineOrder order : {Imf::INCREASING_Y, Imf::DECREASING_Y}) {
      for (const Imath::Box2i& data : kDataWindows) {
        ExrRecipe recipe;
        recipe.display = kDisplay;
        recipe.data = data;
        recipe.types.assign(3, type);
        recipe.compression = GetParam();
        recipe.line_order = order;
        expect_same_as_imf(path_, recipe);
      }
    }
  }
}

TEST_P(ExrCompression, TilesOfEveryTypeOrderAndWindow) {
  for (const SampleType type : {SampleType::half, SampleType::float32, SampleType::uint32}) {
    for (const Imf::LineOrder order : {Imf::INCREASING_Y, Imf::DECREASING_Y, Imf::RANDOM_Y}) {
      for (const Imath::Box2i& data : kDataWindows) {
        ExrRecipe recipe;
        recipe.display = kDisplay;
        recipe.data = data;
        recipe.types.assign(3, type);
        recipe.compression = GetParam();
        recipe.line_order = order;
        recipe.tile_width = 12;
        recipe.tile_height = 9;
        expect_same_as_imf(path_, recipe);
      }
    }
  }
}

TEST_P(ExrCompression, LevelsOfMipMapsAndRipMapsAreLeftAside) {
  for (const Imf::LevelMode levels : {Imf::MIPMAP_LEVELS, Imf::RIPMAP_LEVELS}) {
    for (const SampleType type : {SampleType::half, SampleType::float32}) {
      ExrRecipe recipe;
      recipe.display = recipe.data = kDisplay;
      recipe.types.assign(3, type);
      recipe.compression = GetParam();
      recipe.tile_width = 16;
      recipe.tile_height = 16;
      recipe.levels = levels;
      expect_same_as_imf(path_, recipe);
    }
  }
}

// Widths that no vector and no block of a codec divides; one line; one pixel.
TEST_P(ExrCompression, OddSizes) {
  for (const int width : {1, 2, 3, 5, 8, 17, 31, 65}) {
    for (const int height : {1, 3, 17, 33}) {
      for (const int tile : {0, 8, 200}) {
        ExrRecipe recipe;
        recipe.display = recipe.data = {{0, 0}, {width - 1, height - 1}};
        recipe.compression = GetParam();
        recipe.tile_width = recipe.tile_height = tile;
        expect_same_as_imf(path_, recipe);
      }
    }
  }
}

// Alpha, depth, identifiers and layers beside the colour, of other types, sorted before, between
// and after it, and colour of mixed types.
TEST_P(ExrCompression, OtherChannelsAreLeftAside) {
  for (const int tile : {0, 10}) {
    ExrRecipe recipe;
    recipe.display = recipe.data = kDisplay;
    recipe.compression = GetParam();
    recipe.tile_width = recipe.tile_height = tile;
    recipe.channels = {"R", "G", "B", "A", "C", "Z", "id", "layer.R"};
    recipe.types = {SampleType::half,    SampleType::half,    SampleType::half,   SampleType::half,
                    SampleType::float32, SampleType::float32, SampleType::uint32, SampleType::half};
    expect_same_as_imf(path_, recipe);
    recipe.types[0] = SampleType::float32;
    recipe.types[2] = SampleType::uint32;
    expect_same_as_imf(path_, recipe);
    recipe.channels = {"R", "G", "B", "A"};
    recipe.types.assign(4, SampleType::half);
    expect_same_as_imf(path_, recipe);
  }
}

// Channels beside the colour at reduced resolution change how a chunk's lines are laid out.
TEST_P(ExrCompression, SubsampledChannelsBesideTheColour) {
  ExrRecipe recipe;
  recipe.display = recipe.data = {{0, 0}, {31, 69}};
  recipe.compression = GetParam();
  Imf::Header header = make_header(recipe);
  header.channels().insert("AO", Imf::Channel(Imf::HALF, 2, 2));
  write_exr(path_, recipe, make_raw(32, 70, recipe.types, 1), &header);
  const auto picture = read_raw(path_);
  ASSERT_TRUE(picture) << picture.error().text();
  EXPECT_TRUE(*picture == read_with_imf(path_, {"R", "G", "B"}));
}

// Noise does not become smaller: such chunks are stored as they are.
TEST_P(ExrCompression, NoiseThatDoesNotCompress) {
  RandomNumbers random(5);
  RawPicture noise(33, 70, std::vector<SampleType>(3, SampleType::float32));
  for (auto& plane : noise.planes) {
    for (std::byte& byte : plane) byte = static_cast<std::byte>(random.bits());
  }
  // Not-a-numbers would hide behind themselves in the lossy codecs.
  for (int c = 0; c < 3; ++c) {
    for (std::size_t i = 3; i < noise.planes[c].size(); i += 4) noise.planes[c][i] &= std::byte{63};
  }
  for (const int tile : {0, 16}) {
    ExrRecipe recipe;
    recipe.display = recipe.data = kDisplay;
    recipe.types.assign(3, SampleType::float32);
    recipe.compression = GetParam();
    recipe.tile_width = recipe.tile_height = tile;
    write_exr(path_, recipe, noise);
    const auto picture = read_raw(path_);
    ASSERT_TRUE(picture) << picture.error().text();
    EXPECT_TRUE(*picture == read_with_imf(path_, {"R", "G", "B"}));
  }
}

std::string name_of(const testing::TestParamInfo<Imf::Compression>& parameter) {
  static constexpr std::array kNames = {"NONE",  "RLE", "ZIPS", "ZIP",  "PIZ",
                                        "PXR24", "B44", "B44A", "DWAA", "DWAB"};
  return kNames[parameter.param];
}

INSTANTIATE_TEST_SUITE_P(All, ExrCompression, testing::ValuesIn(kCompressions), name_of);

// What was written comes back, without any decoder to compare with.
TEST(ExrReader, LosslessCodecsGiveBackWhatWasWritten) {
  const TemporaryFolder folder;
  const std::filesystem::path path = folder / "made.exr";
  for (const Imf::Compression compression :
       {Imf::NO_COMPRESSION, Imf::RLE_COMPRESSION, Imf::ZIPS_COMPRESSION, Imf::ZIP_COMPRESSION,
        Imf::PIZ_COMPRESSION}) {
    for (const SampleType type : {SampleType::half, SampleType::float32, SampleType::uint32}) {
      ExrRecipe recipe;
      recipe.display = recipe.data = kDisplay;
      recipe.types.assign(3, type);
      recipe.compression = compression;
      const RawPicture written = make_raw(33, 70, recipe.types, 3);
      write_exr(path, recipe, written);
      const auto picture = read_raw(path);
      ASSERT_TRUE(picture) << picture.error().text();
      EXPECT_TRUE(*picture == written) << compression;
    }
  }
}

}  // namespace
}  // namespace shoal::test
