// Which part and which channels of an EXR file are taken, what is said about them, and what is
// refused with which words.
#include <ImfChromaticitiesAttribute.h>
#include <ImfEnvmap.h>
#include <ImfMultiPartOutputFile.h>
#include <ImfOutputPart.h>
#include <ImfPartType.h>
#include <ImfRgbaFile.h>
#include <ImfStandardAttributes.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "image/exr_file.h"
#include "support/temporary_folder.h"

namespace shoal::test {
namespace {

using testing::HasSubstr;
using testing::IsEmpty;

class ExrSelection : public testing::Test {
 protected:
  Result<std::unique_ptr<PanoramaSource>> open(const ReadOptions& options = {}) const {
    return open_exr(path_, options, portable_chunk_codecs());
  }
  Error error_of(const ReadOptions& options = {}) const {
    const auto source = open(options);
    EXPECT_FALSE(source);
    return source ? Error{} : source.error();
  }
  void write_parts(const std::vector<ExrRecipe>& recipes, const std::vector<RawPicture>& pixels,
                   const std::vector<std::string>& names);

  TemporaryFolder folder_;
  const std::filesystem::path path_ = folder_ / "made.exr";
};

ReadOptions layer(const std::string& name) {
  ReadOptions options;
  options.layer = name;
  return options;
}

ReadOptions part(const std::string& name) {
  ReadOptions options;
  options.part = name;
  return options;
}

void ExrSelection::write_parts(const std::vector<ExrRecipe>& recipes,
                               const std::vector<RawPicture>& pixels,
                               const std::vector<std::string>& names) {
  std::vector<Imf::Header> headers;
  for (std::size_t i = 0; i < recipes.size(); ++i) {
    headers.push_back(make_header(recipes[i]));
    headers.back().setName(names[i]);
    headers.back().setType(Imf::SCANLINEIMAGE);
  }
  Imf::MultiPartOutputFile file(path_.c_str(), headers.data(), static_cast<int>(headers.size()),
                                false, 0);
  for (std::size_t i = 0; i < recipes.size(); ++i) {
    RawPicture copy = pixels[i];
    Imf::OutputPart output(file, static_cast<int>(i));
    output.setFrameBuffer(slices_of(copy, recipes[i].channels, 0, 0));
    output.writePixels(height_of(recipes[i].data));
  }
}

TEST_F(ExrSelection, LayersAreChosenByName) {
  ExrRecipe recipe;
  recipe.channels = {"key.R", "key.G", "key.B", "fill.warm.R", "fill.warm.G", "fill.warm.B", "Z"};
  recipe.types.assign(7, SampleType::half);
  write_exr(path_, recipe);
  const auto key = read_raw(path_, layer("key"));
  ASSERT_TRUE(key) << key.error().text();
  EXPECT_TRUE(*key == read_with_imf(path_, {"key.R", "key.G", "key.B"}));
  const auto fill = read_raw(path_, layer("fill.warm"));
  ASSERT_TRUE(fill) << fill.error().text();
  EXPECT_TRUE(*fill == read_with_imf(path_, {"fill.warm.R", "fill.warm.G", "fill.warm.B"}));
  EXPECT_FALSE(*fill == *key);

  const Error none = error_of();
  EXPECT_EQ(none.code, ErrorCode::unsupported);
  EXPECT_EQ(none.where, path_.string());
  EXPECT_THAT(none.what, HasSubstr("Z, fill.warm.B"));
  EXPECT_EQ(none.hint, "set layer: to one of fill.warm, key");
  const Error wrong = error_of(layer("rim"));
  EXPECT_EQ(wrong.code, ErrorCode::usage);
  EXPECT_EQ(wrong.hint, "set layer: to one of fill.warm, key");
}

TEST_F(ExrSelection, ColourlessFileListsItsChannels) {
  ExrRecipe recipe;
  recipe.channels = {"R", "Z"};
  recipe.types.assign(2, SampleType::half);
  write_exr(path_, recipe);
  const Error error = error_of();
  EXPECT_EQ(error.code, ErrorCode::unsupported);
  EXPECT_THAT(error.what, HasSubstr("R, Z"));
}

TEST_F(ExrSelection, ManyChannelsAreNotAllListed) {
  ExrRecipe recipe;
  recipe.channels.clear();
  for (int i = 100; i < 200; ++i) recipe.channels.push_back("aov" + std::to_string(i));
  recipe.types.assign(100, SampleType::half);
  write_exr(path_, recipe);
  EXPECT_THAT(error_of().what, HasSubstr("and 76 more"));
}

TEST_F(ExrSelection, LuminanceAloneIsGrey) {
  for (const int tile : {0, 16}) {
    ExrRecipe recipe;
    recipe.channels = {"Y", "A"};
    recipe.types = {SampleType::float32, SampleType::half};
    recipe.tile_width = recipe.tile_height = tile;
    write_exr(path_, recipe);
    const auto source = open();
    ASSERT_TRUE(source);
    EXPECT_EQ((*source)->info().channel_count, 1);
    const auto picture = read_raw(**source);
    ASSERT_TRUE(picture) << picture.error().text();
    EXPECT_TRUE(*picture == read_with_imf(path_, {"Y"}));
  }
}

// Against the library's whole picture, in one go.
TEST_F(ExrSelection, LuminanceAndChromaBecomeRgb) {
  const int width = 62;
  const int height = 90;
  for (const Imf::LineOrder order : {Imf::INCREASING_Y, Imf::DECREASING_Y}) {
    RandomNumbers random(1);
    std::vector<Imf::Rgba> pixels(width * height);
    for (Imf::Rgba& pixel : pixels) {
      pixel = {static_cast<float>(random.unit()), static_cast<float>(random.unit()), 0.25f, 1.0f};
    }
    {
      Imf::Header header(width, height, 1, {0, 0}, 1, order, Imf::PIZ_COMPRESSION);
      Imf::RgbaOutputFile file(path_.c_str(), header, Imf::WRITE_YC, 0);
      file.setFrameBuffer(pixels.data(), 1, width);
      file.writePixels(height);
    }
    std::vector<Imf::Rgba> expected(width * height);
    {
      Imf::RgbaInputFile file(path_.c_str(), 0);
      file.setFrameBuffer(expected.data(), 1, width);
      file.readPixels(0, height - 1);
    }
    const auto picture = read_raw(path_);
    ASSERT_TRUE(picture) << picture.error().text();
    RawPicture planar(width, height, std::vector<SampleType>(3, SampleType::half));
    for (int i = 0; i < width * height; ++i) {
      std::memcpy(planar.at(0, i / width, i % width), &expected[i].r, sizeof(half));
      std::memcpy(planar.at(1, i / width, i % width), &expected[i].g, sizeof(half));
      std::memcpy(planar.at(2, i / width, i % width), &expected[i].b, sizeof(half));
    }
    EXPECT_TRUE(*picture == planar) << order;
  }
}

TEST_F(ExrSelection, PartsAreChosenByNameOrNumber) {
  ExrRecipe depth;
  depth.channels = {"Z"};
  depth.types = {SampleType::float32};
  ExrRecipe grey;
  grey.channels = {"Y"};
  grey.types = {SampleType::half};
  const ExrRecipe colour;
  const std::vector<ExrRecipe> recipes = {depth, grey, colour, colour};
  std::vector<RawPicture> pixels;
  for (const ExrRecipe& recipe : recipes) {
    pixels.push_back(make_raw(33, 21, recipe.types, 30 + pixels.size()));
  }
  write_parts(recipes, pixels, {"depth", "fog", "left", "right"});

  const auto expect_part = [&](const ReadOptions& options, int number) {
    const auto picture = read_raw(path_, options);
    ASSERT_TRUE(picture) << picture.error().text();
    EXPECT_TRUE(*picture == pixels[number]) << options.part;
  };
  expect_part({}, 2);  // the first with R, G, B, though a grey one comes before
  expect_part(part("left"), 2);
  expect_part(part("right"), 3);
  expect_part(part("3"), 3);
  expect_part(part("1"), 1);

  const Error wrong = error_of(part("top"));
  EXPECT_EQ(wrong.code, ErrorCode::usage);
  EXPECT_THAT(wrong.hint, HasSubstr("depth, fog, left, right"));
  EXPECT_EQ(error_of(part("4")).code, ErrorCode::usage);
  EXPECT_EQ(error_of(part("-1")).code, ErrorCode::usage);
  EXPECT_EQ(error_of(part("depth")).code, ErrorCode::unsupported);
}

TEST_F(ExrSelection, OnlyPartOfAFileHasNumberZero) {
  write_exr(path_, {});
  EXPECT_TRUE(open(part("0")));
  EXPECT_EQ(error_of(part("1")).code, ErrorCode::usage);
}

TEST_F(ExrSelection, LatLongMapsAreTheirDataWindow) {
  ExrRecipe recipe;
  recipe.data = {{10, 20}, {41, 35}};
  Imf::Header header = make_header(recipe);
  Imf::addEnvmap(header, Imf::ENVMAP_LATLONG);
  write_exr(path_, recipe, make_raw(32, 16, recipe.types, 1), &header);
  const auto source = open();
  ASSERT_TRUE(source);
  EXPECT_EQ((*source)->info().positions, PixelPositions::endpoints);
  EXPECT_EQ((*source)->info().width, 32);
  EXPECT_EQ((*source)->info().height, 16);
  EXPECT_THAT((*source)->info().warnings, IsEmpty());
  const auto picture = read_raw(**source);
  ASSERT_TRUE(picture);
  EXPECT_TRUE(*picture == read_with_imf(path_, recipe.channels, 0, PictureWindow::data));
}

// Its picture is the data window, too.
TEST_F(ExrSelection, CubeMapsSayThatTheyAre) {
  ExrRecipe recipe;
  recipe.data = {{0, 0}, {7, 47}};
  recipe.display = {{0, 0}, {15, 15}};
  Imf::Header header = make_header(recipe);
  Imf::addEnvmap(header, Imf::ENVMAP_CUBE);
  write_exr(path_, recipe, make_raw(8, 48, recipe.types, 1), &header);
  const auto source = open();
  ASSERT_TRUE(source);
  EXPECT_EQ((*source)->info().environment, EnvironmentMap::cube);
  EXPECT_EQ((*source)->info().positions, PixelPositions::endpoints);
  EXPECT_EQ((*source)->info().width, 8);
  EXPECT_EQ((*source)->info().height, 48);
}

TEST_F(ExrSelection, SubsampledColourIsRefused) {
  ExrRecipe recipe;
  recipe.data = recipe.display = {{0, 0}, {31, 31}};
  recipe.channels = {"R", "G"};
  recipe.types.assign(2, SampleType::half);
  Imf::Header header = make_header(recipe);
  header.channels().insert("B", Imf::Channel(Imf::HALF, 2, 2));
  write_exr(path_, recipe, make_raw(32, 32, recipe.types, 1), &header);
  EXPECT_EQ(error_of().code, ErrorCode::unsupported);
  EXPECT_THAT(error_of().what, HasSubstr("channel B at reduced resolution (2 x 2)"));
}

TEST_F(ExrSelection, BlackOutsideOfTheDataWindowIsAWarning) {
  ExrRecipe recipe;
  recipe.display = {{0, 0}, {39, 19}};
  recipe.data = {{10, 0}, {29, 99}};  // half of the width, all of the height
  write_exr(path_, recipe);
  const auto source = open();
  ASSERT_TRUE(source);
  ASSERT_EQ((*source)->info().warnings.size(), 1u);
  EXPECT_THAT((*source)->info().warnings[0], HasSubstr("covers 50 % of the picture"));

  recipe.data = {{-10, -10}, {100, 100}};
  write_exr(path_, recipe);
  const auto larger = open();
  ASSERT_TRUE(larger);
  EXPECT_THAT((*larger)->info().warnings, IsEmpty());
}

TEST_F(ExrSelection, ForeignChromaticitiesAreAWarning) {
  const auto warnings = [&](const Imf::Chromaticities& primaries) {
    const ExrRecipe recipe;
    Imf::Header header = make_header(recipe);
    Imf::addChromaticities(header, primaries);
    write_exr(path_, recipe, make_raw(33, 21, recipe.types, 1), &header);
    const auto source = open();
    return source ? (*source)->info().warnings : std::vector<std::string>{"not opened"};
  };
  EXPECT_THAT(warnings({}), IsEmpty());  // OpenEXR's default is Rec. 709
  EXPECT_THAT(warnings({{0.64f, 0.33f}, {0.3f, 0.6f}, {0.15f, 0.06f}, {0.31271f, 0.32902f}}),
              IsEmpty());
  const auto wide =
      warnings({{0.708f, 0.292f}, {0.17f, 0.797f}, {0.131f, 0.046f}, {0.3127f, 0.329f}});
  ASSERT_EQ(wide.size(), 1u);
  EXPECT_THAT(wide[0], HasSubstr("red 0.708 0.292"));
}

TEST_F(ExrSelection, FormatIsToldToPeople) {
  ExrRecipe recipe;
  write_exr(path_, recipe);
  EXPECT_EQ((*open())->info().format, "OpenEXR half ZIP");
  recipe.compression = Imf::PIZ_COMPRESSION;
  recipe.types.assign(3, SampleType::float32);
  recipe.tile_width = recipe.tile_height = 8;
  write_exr(path_, recipe);
  EXPECT_EQ((*open())->info().format, "OpenEXR float PIZ tiles");
}

}  // namespace
}  // namespace shoal::test
