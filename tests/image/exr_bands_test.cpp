// Bands: however a picture is cut, in whichever order and by however many readers it is read, its
// samples are the same, and each row comes once.
#include <ImfMultiPartOutputFile.h>
#include <ImfOutputPart.h>
#include <ImfPartType.h>
#include <ImfRgbaFile.h>
#include <gtest/gtest.h>

#include <fstream>
#include <numeric>
#include <random>
#include <thread>

#include "image/exr_context.h"
#include "image/exr_file.h"
#include "image/exr_inflate.h"
#include "support/temporary_folder.h"

namespace shoal::test {
namespace {

class ExrBands : public testing::Test {
 protected:
  TemporaryFolder folder_;
  const std::filesystem::path path_ = folder_ / "made.exr";
};

// One file a path through the reader: raw lines, deflated chunks, the C library, tiles, C++
// classes.
std::vector<ExrRecipe> one_of_each_kind() {
  std::vector<ExrRecipe> recipes;
  for (const Imf::Compression compression :
       {Imf::NO_COMPRESSION, Imf::ZIPS_COMPRESSION, Imf::ZIP_COMPRESSION, Imf::PIZ_COMPRESSION,
        Imf::DWAA_COMPRESSION}) {
    ExrRecipe recipe;
    recipe.display = {{0, 0}, {40, 150}};
    recipe.data = {{-3, 21}, {30, 170}};
    recipe.compression = compression;
    recipes.push_back(recipe);
    recipe.line_order = Imf::DECREASING_Y;
    recipes.push_back(recipe);
    recipe.tile_width = 16;
    recipe.tile_height = 11;
    recipes.push_back(recipe);
  }
  return recipes;
}

void write_luminance_chroma(const std::filesystem::path& path, int width, int height) {
  RandomNumbers random(11);
  std::vector<Imf::Rgba> pixels(static_cast<std::size_t>(width) * height);
  for (Imf::Rgba& pixel : pixels) {
    pixel = {static_cast<float>(random.unit()), static_cast<float>(random.unit()), 0.5f, 1.0f};
  }
  Imf::RgbaOutputFile file(path.c_str(), width, height, Imf::WRITE_YC);
  file.setFrameBuffer(pixels.data(), 1, width);
  file.writePixels(height);
}

TEST_F(ExrBands, HeightDoesNotChangeTheSamples) {
  for (const ExrRecipe& recipe : one_of_each_kind()) {
    write_exr(path_, recipe);
    const RawPicture expected = read_with_imf(path_, recipe.channels);
    for (const int rows : {1, 2, 7, 16, 33, 64, 100000}) {
      ReadOptions options;
      options.rows_per_band = rows;
      const auto picture = read_raw(path_, options);
      ASSERT_TRUE(picture) << picture.error().text();
      EXPECT_TRUE(*picture == expected) << recipe.compression << " in bands of " << rows;
    }
  }
}

TEST_F(ExrBands, HeightIsRoundedUpToWholeChunks) {
  const auto rows_per_band = [&](Imf::Compression compression, int tile, int wanted) {
    ExrRecipe recipe;
    recipe.display = recipe.data = {{0, 0}, {40, 599}};
    recipe.compression = compression;
    recipe.tile_width = recipe.tile_height = tile;
    write_exr(path_, recipe);
    ReadOptions options;
    options.rows_per_band = wanted;
    const auto source = open_exr(path_, options, portable_chunk_codecs());
    return source ? (*source)->info().rows_per_band : -1;
  };
  EXPECT_EQ(rows_per_band(Imf::NO_COMPRESSION, 0, 5), 5);
  EXPECT_EQ(rows_per_band(Imf::ZIPS_COMPRESSION, 0, 1), 1);
  EXPECT_EQ(rows_per_band(Imf::ZIP_COMPRESSION, 0, 1), 16);
  EXPECT_EQ(rows_per_band(Imf::ZIP_COMPRESSION, 0, 17), 32);
  EXPECT_EQ(rows_per_band(Imf::PIZ_COMPRESSION, 0, 1), 32);
  EXPECT_EQ(rows_per_band(Imf::DWAB_COMPRESSION, 0, 1), 256);
  EXPECT_EQ(rows_per_band(Imf::ZIP_COMPRESSION, 24, 25), 48);
  // The reader's choice: what is fastest.
  EXPECT_EQ(rows_per_band(Imf::ZIPS_COMPRESSION, 0, 0), 32);
  EXPECT_EQ(rows_per_band(Imf::ZIP_COMPRESSION, 0, 0), 64);
  EXPECT_EQ(rows_per_band(Imf::PXR24_COMPRESSION, 0, 0), 64);
  EXPECT_EQ(rows_per_band(Imf::B44_COMPRESSION, 0, 0), 32);
  EXPECT_EQ(rows_per_band(Imf::ZIP_COMPRESSION, 24, 0), 24);
}

// Two readers of one source, each in an order of its own, one band at a time in turn.
TEST_F(ExrBands, ReadersAreIndependentAndBandsComeInAnyOrder) {
  std::vector<std::filesystem::path> paths;
  for (const ExrRecipe& recipe : one_of_each_kind()) {
    paths.push_back(folder_ / (std::to_string(paths.size()) + ".exr"));
    write_exr(paths.back(), recipe);
  }
  paths.push_back(folder_ / "chroma.exr");
  write_luminance_chroma(paths.back(), 60, 150);

  for (const auto& path : paths) {
    const auto source = open_exr(path, {}, portable_chunk_codecs());
    ASSERT_TRUE(source) << source.error().text();
    const PictureInfo& info = (*source)->info();
    const auto expected = read_raw(**source);
    ASSERT_TRUE(expected) << expected.error().text();
    auto forward = (*source)->new_reader();
    auto shuffled = (*source)->new_reader();
    ASSERT_TRUE(forward && shuffled);
    std::vector<int> order(info.band_count);
    std::iota(order.begin(), order.end(), 0);
    std::shuffle(order.begin(), order.end(), std::mt19937(7));

    RawPicture first(info.width, info.height, expected->types);
    RawPicture second(info.width, info.height, expected->types);
    for (int i = 0; i < info.band_count; ++i) {
      const auto band = (*forward)->read(i);
      const auto other = (*shuffled)->read(order[i]);
      ASSERT_TRUE(band && other);
      store_band(*band,
                 first);  // after the other reader's read: it must not have touched this band
      store_band(*other, second);
    }
    EXPECT_TRUE(first == *expected) << path;
    EXPECT_TRUE(second == *expected) << path;
  }
}

// A reader a thread, all of one source.
TEST_F(ExrBands, ThreadsShareASource) {
  for (const ExrRecipe& recipe : one_of_each_kind()) {
    write_exr(path_, recipe);
    const RawPicture expected = read_with_imf(path_, recipe.channels);
    const auto source = open_exr(path_, {}, portable_chunk_codecs());
    ASSERT_TRUE(source) << source.error().text();
    std::array<RawPicture, 4> pictures;
    std::vector<std::thread> threads;
    for (RawPicture& picture : pictures) {
      threads.emplace_back([&] {
        const auto read = read_raw(**source);
        if (read) picture = *read;
      });
    }
    for (std::thread& thread : threads) thread.join();
    for (const RawPicture& picture : pictures) EXPECT_TRUE(picture == expected);
  }
}

TEST_F(ExrBands, ReaderOutlivesItsSource) {
  write_exr(path_, {});
  auto source = open_exr(path_, {}, portable_chunk_codecs());
  ASSERT_TRUE(source);
  auto reader = (*source)->new_reader();
  ASSERT_TRUE(reader);
  source->reset();
  EXPECT_TRUE((*reader)->read(0));
}

TEST_F(ExrBands, BandThatIsNotThereIsAnError) {
  write_exr(path_, {});
  const auto source = open_exr(path_, {}, portable_chunk_codecs());
  ASSERT_TRUE(source);
  auto reader = (*source)->new_reader();
  ASSERT_TRUE(reader);
  EXPECT_FALSE((*reader)->read(-1));
  EXPECT_FALSE((*reader)->read((*source)->info().band_count));
}

// Lines without compression are not copied: planes point at the bytes as they were read, so a row
// is followed by the next chunk's leader (8 bytes), or preceded by it when lines run upwards.
TEST_F(ExrBands, UncompressedLinesAreShownInPlace) {
  for (const Imf::LineOrder order : {Imf::INCREASING_Y, Imf::DECREASING_Y}) {
    ExrRecipe recipe;
    recipe.compression = Imf::NO_COMPRESSION;
    recipe.line_order = order;
    write_exr(path_, recipe);
    const auto source = open_exr(path_, {}, portable_chunk_codecs());
    ASSERT_TRUE(source);
    auto reader = (*source)->new_reader();
    ASSERT_TRUE(reader);
    const auto band = (*reader)->read(0);
    ASSERT_TRUE(band);
    const std::ptrdiff_t line = 33 * 3 * 2 + 8;
    EXPECT_EQ(band->channels[0].row_stride, order == Imf::INCREASING_Y ? line : -line);
    // The file's order of channels is alphabetical: B, G, R.
    EXPECT_EQ(band->channels[0].data - band->channels[2].data, 33 * 2 * 2);
  }
}

// Parts whose chunks alternate in the file: part 1 of lines a, part 0 of lines a, part 1 of ...
TEST_F(ExrBands, PartsWithAlternatingChunks) {
  for (const Imf::Compression compression : {Imf::NO_COMPRESSION, Imf::ZIP_COMPRESSION}) {
    ExrRecipe recipe;
    recipe.display = recipe.data = {{0, 0}, {32, 99}};
    recipe.compression = compression;
    std::vector<Imf::Header> headers;
    std::vector<RawPicture> pixels;
    for (int part = 0; part < 2; ++part) {
      headers.push_back(make_header(recipe));
      headers.back().setName("part" + std::to_string(part));
      headers.back().setType(Imf::SCANLINEIMAGE);
      pixels.push_back(make_raw(33, 100, recipe.types, 20 + part));
    }
    {
      Imf::MultiPartOutputFile file(path_.c_str(), headers.data(), 2, false, 0);
      std::vector<Imf::OutputPart> parts = {{file, 0}, {file, 1}};
      for (int part = 0; part < 2; ++part) {
        parts[part].setFrameBuffer(slices_of(pixels[part], recipe.channels, 0, 0));
      }
      for (int line = 0; line < 100; line += 20) {
        for (const int part : {1, 0}) parts[part].writePixels(20);
      }
    }
    for (int part = 0; part < 2; ++part) {
      ReadOptions options;
      options.part = std::to_string(part);
      const auto picture = read_raw(path_, options);
      ASSERT_TRUE(picture) << picture.error().text();
      EXPECT_TRUE(*picture == pixels[part]) << compression << " part " << part;
    }
  }
}

// A writer that is killed leaves its table of chunks zero; the lines are there nevertheless.
TEST_F(ExrBands, ChunksAreFoundWithoutTheirTable) {
  for (const Imf::Compression compression :
       {Imf::NO_COMPRESSION, Imf::ZIP_COMPRESSION, Imf::PIZ_COMPRESSION, Imf::DWAA_COMPRESSION}) {
    ExrRecipe recipe;
    recipe.display = recipe.data = {{0, 0}, {32, 99}};
    recipe.compression = compression;
    write_exr(path_, recipe);
    const RawPicture expected = read_with_imf(path_, recipe.channels);
    {
      const auto context = ExrContext::open(path_);
      ASSERT_TRUE(context);
      const ExrContext::TableExtent table = (*context)->table(0);
      std::fstream file(path_, std::ios::in | std::ios::out | std::ios::binary);
      file.seekp(static_cast<std::streamoff>(table.offset));
      const std::string zeros(table.count * sizeof(std::uint64_t), '\0');
      file.write(zeros.data(), static_cast<std::streamsize>(zeros.size()));
    }
    const auto picture = read_raw(path_);
    ASSERT_TRUE(picture) << picture.error().text();
    EXPECT_TRUE(*picture == expected) << compression;
  }
}

// The predictor and the split as the format describes them, done forwards here: split into even and
// odd bytes, then differences of neighbours plus 128.
TEST(ChunkCodecs, UndoesPredictorAndSplit) {
  RandomNumbers random(3);
  for (std::size_t size = 0; size < 200; ++size) {
    std::vector<std::byte> pixels(size);
    for (std::byte& byte : pixels) byte = static_cast<std::byte>(random.bits());
    std::vector<std::byte> shuffled;
    for (std::size_t i = 0; i < size; i += 2) shuffled.push_back(pixels[i]);
    for (std::size_t i = 1; i < size; i += 2) shuffled.push_back(pixels[i]);
    for (std::size_t i = size; i-- > 1;) {
      shuffled[i] = static_cast<std::byte>(std::to_integer<int>(shuffled[i]) -
                                           std::to_integer<int>(shuffled[i - 1]) + 128);
    }
    std::vector<std::byte> out(size);
    portable_chunk_codecs().undo_predictor_and_split(shuffled.data(), size, out.data());
    EXPECT_EQ(out, pixels);
  }
}

std::vector<std::byte> bytes_of(std::initializer_list<int> values) {
  std::vector<std::byte> bytes;
  for (const int value : values) bytes.push_back(static_cast<std::byte>(value));
  return bytes;
}

TEST(ExrRuns, ExpandToExactlyTheirSize) {
  const auto packed = bytes_of({2, 7, -3, 1, 2, 3, 0, 9});  // 7 7 7, 1 2 3, 9
  std::vector<std::byte> out(7);
  EXPECT_EQ(expand_exr_runs(packed, out), Expansion::done);
  EXPECT_EQ(out, bytes_of({7, 7, 7, 1, 2, 3, 9}));
  for (const std::size_t wrong : {0, 1, 6, 8}) {
    out.resize(wrong);
    EXPECT_EQ(expand_exr_runs(packed, out), Expansion::damaged) << wrong;
  }
  // -128 stands for 128 bytes as they are: the count is not to overflow.
  std::vector<std::byte> longest = bytes_of({-128});
  longest.resize(129, std::byte{5});
  out.assign(128, std::byte{0});
  EXPECT_EQ(expand_exr_runs(longest, out), Expansion::done);
  EXPECT_EQ(out, std::vector<std::byte>(128, std::byte{5}));
}

TEST(ExrRuns, CutOffInTheMiddleIsDamaged) {
  std::vector<std::byte> out(7);
  for (const auto& packed : {bytes_of({6}), bytes_of({-7, 1, 2, 3}), bytes_of({-7})}) {
    EXPECT_EQ(expand_exr_runs(packed, out), Expansion::damaged);
  }
}

}  // namespace
}  // namespace shoal::test
