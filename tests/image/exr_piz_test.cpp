// PIZ: what comes out equals, bit for bit, what OpenEXR's C++ classes decode; and whatever is in a
// chunk, expanding it ends in a picture or in an error.
#include <gtest/gtest.h>
#include <openexr.h>

#include <bit>
#include <functional>

#include "image/exr_file.h"
#include "image/exr_piz.h"
#include "support/temporary_folder.h"

namespace shoal::test {
namespace {

const std::vector<std::string> kColour = {"R", "G", "B"};

class ExrPiz : public testing::Test {
 protected:
  static ExrRecipe recipe_of(const RawPicture& pixels) {
    ExrRecipe recipe;
    recipe.data = recipe.display = {{0, 0}, {pixels.width - 1, pixels.height - 1}};
    recipe.types = pixels.types;
    recipe.compression = Imf::PIZ_COMPRESSION;
    return recipe;
  }
  // PIZ loses nothing, so that what was written is what OpenEXR must read, too.
  void expect_kept(const ExrRecipe& recipe, const RawPicture& pixels) {
    write_exr(path_, recipe, pixels);
    const auto picture = read_raw(path_);
    ASSERT_TRUE(picture) << picture.error().text();
    EXPECT_TRUE(*picture == pixels) << pixels.width << " x " << pixels.height;
    EXPECT_TRUE(*picture == read_with_imf(path_, kColour));
  }
  // The chunks of the file as they are stored.
  std::vector<std::vector<std::byte>> packed_chunks();

  TemporaryFolder folder_;
  const std::filesystem::path path_ = folder_ / "made.exr";
};

std::vector<std::vector<std::byte>> ExrPiz::packed_chunks() {
  std::vector<std::vector<std::byte>> chunks;
  exr_context_t context = nullptr;
  const exr_context_initializer_t settings = EXR_DEFAULT_CONTEXT_INITIALIZER;
  EXPECT_EQ(exr_start_read(&context, path_.c_str(), &settings), EXR_ERR_SUCCESS);
  exr_attr_box2i_t window{};
  EXPECT_EQ(exr_get_data_window(context, 0, &window), EXR_ERR_SUCCESS);
  for (int y = window.min.y; y <= window.max.y; y += 32) {
    exr_chunk_info_t info{};
    EXPECT_EQ(exr_read_scanline_chunk_info(context, 0, y, &info), EXR_ERR_SUCCESS);
    chunks.emplace_back(info.packed_size);
    EXPECT_EQ(exr_read_chunk(context, 0, &info, chunks.back().data()), EXR_ERR_SUCCESS);
  }
  exr_finish(&context);
  return chunks;
}

// Fills all samples with what `bits` gives for a channel, row and column.
RawPicture painted(int width, int height, const std::vector<SampleType>& types,
                   const std::function<std::uint32_t(int, int, int)>& bits) {
  RawPicture pixels(width, height, types);
  for (int c = 0; c < static_cast<int>(types.size()); ++c) {
    for (int y = 0; y < height; ++y) {
      for (int x = 0; x < width; ++x) {
        const std::uint32_t sample = bits(c, y, x);
        std::memcpy(pixels.at(c, y, x), &sample, sample_size(types[c]));
      }
    }
  }
  return pixels;
}

constexpr auto kHalf = SampleType::half;
constexpr auto kFloat = SampleType::float32;
constexpr auto kUint = SampleType::uint32;
const std::vector<std::vector<SampleType>> kTypes = {{kHalf, kHalf, kHalf},
                                                     {kFloat, kFloat, kFloat},
                                                     {kUint, kUint, kUint},
                                                     {kHalf, kFloat, kUint},
                                                     {kFloat, kHalf, kHalf}};

// 300 x 70: three chunks, the last one short; enough bits to be decoded in several stretches.
TEST_F(ExrPiz, KeepsEveryKindOfContent) {
  RandomNumbers random(11);
  const std::vector<std::function<std::uint32_t(int, int, int)>> contents = {
      [](int, int, int) { return 0u; },
      [](int c, int, int) { return 0x3c003c00u + static_cast<unsigned>(c); },
      [](int c, int y, int x) { return static_cast<unsigned>(x * 90 + y * 7 + c); },
      [&](int, int, int) { return static_cast<std::uint32_t>(random.bits() & 0x00ff00ff); },
      // One channel has next to no bits, so that stretches differ most in their symbols.
      [&](int c, int, int) {
        return c == 1 ? 7u : static_cast<std::uint32_t>(random.bits() & 1023);
      },
      // Runs of many lengths, and none.
      [&](int, int y, int x) { return x % (y * 5 + 1) == 0 ? 1u << (x % 30) : 0u; },
      // Infinities and not-a-numbers of both signs, of halves and floats.
      [&](int, int, int x) { return (random.bits() & 1 ? 0x7f807c00u : 0xffc1fe01u) + (x % 3); },
  };
  for (const auto& types : kTypes) {
    for (const auto& content : contents) {
      const RawPicture pixels = painted(300, 70, types, content);
      expect_kept(recipe_of(pixels), pixels);
    }
  }
}

// With more than 2^14 different values in a chunk the wavelet is another one.
TEST_F(ExrPiz, KeepsValuesBeyondFourteenBits) {
  RandomNumbers random(12);
  for (const auto& types : kTypes) {
    const RawPicture pixels = painted(900, 40, types, [&](int, int, int x) {
      return x < 450 ? static_cast<std::uint32_t>(random.bits()) : 5u;
    });
    expect_kept(recipe_of(pixels), pixels);
    const std::vector<std::byte> chunk = packed_chunks()[0];
    std::size_t pixel_bytes = 0;
    for (const SampleType type : types) pixel_bytes += sample_size(type);
    ASSERT_LT(chunk.size(), 900 * 32 * pixel_bytes) << "stored as it is";
    std::uint16_t first = 0;
    std::uint16_t last = 0;
    std::memcpy(&first, chunk.data(), sizeof first);
    std::memcpy(&last, chunk.data() + 2, sizeof last);
    int values = 0;
    for (int i = 0; i <= last - first; ++i) {
      values += std::popcount(std::to_integer<unsigned>(chunk[4 + i]));
    }
    EXPECT_GT(values, 1 << 14);
  }
}

TEST_F(ExrPiz, KeepsEverySize) {
  const auto types = kTypes[3];
  for (int size = 1; size <= 70; ++size) {
    for (const auto& [width, height] : {std::pair{size, 5}, {size, 33}, {37, size}, {1, size}}) {
      const RawPicture pixels = make_raw(width, height, types, static_cast<std::uint64_t>(size));
      expect_kept(recipe_of(pixels), pixels);
    }
  }
}

TEST_F(ExrPiz, KeepsTilesOfEverySize) {
  for (const auto& types : kTypes) {
    const RawPicture pixels = make_raw(75, 50, types, 4);
    for (const auto& [width, height] :
         {std::pair{15, 5}, {16, 16}, {33, 7}, {64, 48}, {200, 200}}) {
      ExrRecipe recipe = recipe_of(pixels);
      recipe.tile_width = width;
      recipe.tile_height = height;
      expect_kept(recipe, pixels);
    }
  }
}

class ExrPizHostile : public ExrPiz {
 protected:
  // Flips some bits of `bytes`, or cuts them off, mostly near the front, where a bit does most.
  void damage(std::vector<std::byte>& bytes) {
    const int size = static_cast<int>(bytes.size());
    for (int flips = 1 + random_.below(3); flips > 0; --flips) {
      const int span = random_.below(2) == 0 ? size : std::min(size, 1 + random_.below(size));
      bytes[random_.below(span)] ^= static_cast<std::byte>(1 << random_.below(8));
    }
    if (random_.below(8) == 0) bytes.resize(random_.below(size));
  }
  RandomNumbers random_{31};
};

TEST_F(ExrPizHostile, DamagedChunksStayInTheirBounds) {
  for (const auto& [width, height] : {std::pair{9, 32}, {150, 32}}) {
    const RawPicture pixels =
        painted(width, height, {kHalf, kUint, kFloat}, [&](int, int y, int x) {
          return x % 5 == 0 ? static_cast<unsigned>(y)
                            : static_cast<std::uint32_t>(random_.bits() & 63);
        });
    write_exr(path_, recipe_of(pixels), pixels);
    const std::vector<std::byte> whole = packed_chunks()[0];
    // In the file's order: B, G, R.
    const std::array types = {kFloat, kUint, kHalf};
    const ExrChunkShape shape{types, static_cast<std::size_t>(width),
                              static_cast<std::size_t>(height)};
    ASSERT_LT(whole.size(), shape.width * shape.rows * 10) << "stored as it is";
    PizExpander expander(portable_chunk_codecs());
    int done = 0;
    for (int round = 0; round < 6000; ++round) {
      std::vector<std::byte> packed = whole;
      damage(packed);
      packed.shrink_to_fit();  // so that a sanitizer sees what reads beyond
      std::vector<std::byte> out(shape.width * shape.rows * 10);
      if (expander.expand(packed, shape, out) == Expansion::done) ++done;
    }
    EXPECT_GT(done, 0);
    EXPECT_LT(done, 6000);
    std::vector<std::byte> out(shape.width * shape.rows * 10);
    EXPECT_EQ(expander.expand(whole, shape, out), Expansion::done) << "it stays usable";
  }
}

// What is accepted though it is damaged is what OpenEXR makes of it. (OpenEXR accepts more: codes
// that end up to 128 bits too early, or too late.)
TEST_F(ExrPizHostile, WhatIsAcceptedIsWhatOpenExrReads) {
  const RawPicture pixels = make_raw(60, 32, kTypes[0], 6);
  write_exr(path_, recipe_of(pixels), pixels);
  const std::vector<std::byte> chunk = packed_chunks()[0];
  std::vector<std::byte> file(std::filesystem::file_size(path_));
  std::FILE* stream = std::fopen(path_.c_str(), "rb");
  ASSERT_EQ(std::fread(file.data(), 1, file.size(), stream), file.size());
  std::fclose(stream);
  const auto at = std::search(file.begin(), file.end(), chunk.begin(), chunk.end());
  ASSERT_NE(at, file.end());
  int accepted = 0;
  for (int round = 0; round < 1500; ++round) {
    std::vector<std::byte> damaged = chunk;
    damage(damaged);
    if (damaged.size() != chunk.size()) continue;
    std::copy(damaged.begin(), damaged.end(), at);
    std::filesystem::remove(path_);
    stream = std::fopen(path_.c_str(), "wb");
    std::fwrite(file.data(), 1, file.size(), stream);
    std::fclose(stream);
    const auto picture = read_raw(path_);
    if (!picture) continue;
    ++accepted;
    ASSERT_NO_THROW(EXPECT_TRUE(*picture == read_with_imf(path_, kColour)) << round);
  }
  EXPECT_GT(accepted, 10);
}

}  // namespace
}  // namespace shoal::test
