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

// Bits, from the top of bytes.
class BitWriter {
 public:
  void put(int count, std::uint64_t bits) {
    while (count-- > 0) {
      if (count_++ % 8 == 0) bytes_.push_back(std::byte{0});
      if (bits >> count & 1) bytes_.back() |= std::byte{0x80} >> ((count_ - 1) % 8);
    }
  }
  [[nodiscard]] const std::vector<std::byte>& bytes() const { return bytes_; }
  [[nodiscard]] std::uint32_t count() const { return count_; }

 private:
  std::vector<std::byte> bytes_;
  std::uint32_t count_ = 0;
};

// A Huffman-coded stream as PIZ has it, made by hand. Symbols are those from 0 on, with codes of
// the given lengths; the last one stands for a run.
struct Stream {
  std::vector<int> lengths;
  BitWriter codes;

  void put(std::size_t symbol) { codes.put(lengths[symbol], code_of(symbol)); }
  void put_run(std::uint64_t count) {
    put(lengths.size() - 1);
    codes.put(8, count);
  }
  // Among codes of a length they grow with the symbol; below them lie, filled up with zeros, all
  // that are longer.
  [[nodiscard]] std::uint64_t code_of(std::size_t symbol) const {
    double longer = 0;
    std::uint64_t before = 0;
    for (std::size_t s = 0; s < lengths.size(); ++s) {
      if (lengths[s] > lengths[symbol]) longer += std::ldexp(1.0, lengths[symbol] - lengths[s]);
      if (lengths[s] == lengths[symbol] && s < symbol) ++before;
    }
    return static_cast<std::uint64_t>(longer) + before;
  }
  [[nodiscard]] std::vector<std::byte> packed() const { return packed(codes.count()); }
  [[nodiscard]] std::vector<std::byte> packed(std::uint32_t bit_count) const {
    BitWriter table;
    for (const int length : lengths) table.put(6, static_cast<std::uint64_t>(length));
    const std::array<std::uint32_t, 5> header = {0, static_cast<std::uint32_t>(lengths.size() - 1),
                                                 static_cast<std::uint32_t>(table.bytes().size()),
                                                 bit_count, 0};
    std::vector<std::byte> bytes(sizeof header);
    std::memcpy(bytes.data(), header.data(), sizeof header);
    bytes.insert(bytes.end(), table.bytes().begin(), table.bytes().end());
    bytes.insert(bytes.end(), codes.bytes().begin(), codes.bytes().end());
    return bytes;
  }
};

// The symbols, or nothing where the stream is damaged.
std::optional<std::vector<std::uint16_t>> decoded(const std::vector<std::byte>& packed,
                                                  std::size_t count) {
  PizHuffmanDecoder decoder;
  std::vector<std::uint16_t> symbols(count);
  if (!decoder.decode(packed, symbols)) return std::nullopt;
  return symbols;
}

using Symbols = std::vector<std::uint16_t>;

// Codes 1, 00 and 01.
TEST(PizHuffman, DecodesByHand) {
  Stream stream{{1, 2, 2}, {}};
  for (const std::size_t symbol : {0, 1, 1, 0}) stream.put(symbol);
  stream.put_run(3);
  EXPECT_EQ(stream.codes.bytes()[0], std::byte{0b10000101});
  EXPECT_EQ(decoded(stream.packed(), 7), (Symbols{0, 1, 1, 0, 0, 0, 0}));
}

TEST(PizHuffman, RefusesWhatDoesNotFitExactly) {
  Stream stream{{1, 2, 2}, {}};
  for (const std::size_t symbol : {0, 1, 1, 0}) stream.put(symbol);
  stream.put_run(3);
  const std::uint32_t bits = stream.codes.count();
  EXPECT_FALSE(decoded(stream.packed(), 6)) << "a run beyond the end";
  EXPECT_FALSE(decoded(stream.packed(), 8)) << "a symbol is missing";
  EXPECT_FALSE(decoded(stream.packed(bits - 1), 7)) << "the last bit is missing";
  EXPECT_FALSE(decoded(stream.packed(bits + 1), 7)) << "a bit is left";
  EXPECT_FALSE(decoded(stream.packed(1000), 7)) << "bits are missing";
  std::vector<std::byte> packed = stream.packed();
  packed.resize(19);
  EXPECT_FALSE(decoded(packed, 7)) << "no header";
  EXPECT_FALSE(decoded({}, 7));
}

TEST(PizHuffman, RefusesRunsOfNothing) {
  Stream of_no_symbol{{1, 2, 2}, {}};
  of_no_symbol.put_run(3);
  EXPECT_FALSE(decoded(of_no_symbol.packed(), 3));
  Stream of_no_length{{1, 2, 2}, {}};
  of_no_length.put(0);
  of_no_length.put_run(0);
  EXPECT_FALSE(decoded(of_no_length.packed(), 1));
}

// The lengths l of a complete prefix code have 2^-l that add up to 1.
TEST(PizHuffman, RefusesCodesThatAreNotComplete) {
  for (const std::vector<int>& lengths :
       {std::vector<int>{1, 2, 3}, {1, 1, 1}, {1, 1, 2}, {2, 2, 2}, {0, 0}, {1}, {0, 58, 58}}) {
    Stream stream{lengths, {}};
    stream.codes.put(64, 0);
    for (std::uint32_t bits = 1; bits <= 64; ++bits) {
      EXPECT_FALSE(decoded(stream.packed(bits), bits)) << lengths.size();
      EXPECT_FALSE(decoded(stream.packed(bits), 1)) << lengths.size();
    }
  }
}

TEST(PizHuffman, RefusesSymbolsThatCannotBe) {
  Stream stream{{1, 2, 2}, {}};
  stream.put(0);
  for (const auto& [first, last] : {std::pair{0u, 65537u},
                                    {3u, 2u},
                                    {0u, 0xffffffffu},
                                    {0xffffffffu, 0xffffffffu},
                                    {65537u, 65537u}}) {
    std::vector<std::byte> packed = stream.packed();
    std::memcpy(packed.data(), &first, sizeof first);
    std::memcpy(packed.data() + 4, &last, sizeof last);
    EXPECT_FALSE(decoded(packed, 1));
  }
}

// Codes of 1 to 40 bits: looked up, searched for, and longer than a fetch is sure to be whole.
TEST(PizHuffman, DecodesLongCodes) {
  Stream stream;
  for (int length = 1; length <= 40; ++length) stream.lengths.push_back(length);
  stream.lengths.push_back(40);
  RandomNumbers random(21);
  Symbols symbols;
  for (int i = 0; i < 5000; ++i) {
    symbols.push_back(static_cast<std::uint16_t>(random.below(40)));
    stream.put(symbols.back());
  }
  symbols.insert(symbols.end(), 255, symbols.back());
  stream.put_run(255);
  EXPECT_EQ(decoded(stream.packed(), symbols.size()), symbols);
}

// Where all codes are equally long, one that begins in the middle of a code never falls into step.
TEST(PizHuffman, DecodesWhatNeverFallsIntoStep) {
  RandomNumbers random(22);
  for (const int length : {3, 5, 13}) {
    Stream stream{std::vector<int>(std::size_t{1} << length, length), {}};
    const auto run_code = (1 << length) - 1;
    for (const int count : {40000, 40001, 40002, 40003}) {
      stream.codes = {};
      Symbols symbols;
      for (int i = 0; i < count; ++i) {
        // The code of a symbol is the symbol itself.
        symbols.push_back(static_cast<std::uint16_t>(random.below(run_code)));
        stream.codes.put(length, symbols.back());
      }
      EXPECT_EQ(decoded(stream.packed(), symbols.size()), symbols) << length << " " << count;
      EXPECT_FALSE(decoded(stream.packed(), symbols.size() - 1));
      EXPECT_FALSE(decoded(stream.packed(), symbols.size() + 1));
    }
  }
}

// Runs everywhere: a stretch may begin with one, and repeats what it does not know.
TEST(PizHuffman, DecodesRunsAcrossTheCuts) {
  RandomNumbers random(23);
  for (int round = 0; round < 200; ++round) {
    Stream stream{{3, 3, 2, 14, 14, 13, 12, 11, 10, 9, 8, 7, 6, 5, 4, 3, 2}, {}};
    Symbols symbols;
    while (stream.codes.count() < 20000) {
      const auto symbol = static_cast<std::uint16_t>(random.below(16));
      stream.put(symbol);
      symbols.push_back(symbol);
      for (int runs = random.below(4); runs > 0; --runs) {
        const int count = 1 + random.below(255);
        stream.put_run(static_cast<std::uint64_t>(count));
        symbols.insert(symbols.end(), static_cast<std::size_t>(count), symbol);
      }
    }
    ASSERT_TRUE(decoded(stream.packed(), symbols.size()) == symbols) << round;
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
