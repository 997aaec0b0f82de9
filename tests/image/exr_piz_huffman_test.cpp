// PIZ's Huffman code, on streams made by hand.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstring>
#include <optional>
#include <vector>

#include "image/exr_file.h"
#include "image/exr_piz.h"

namespace shoal::test {
namespace {

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

}  // namespace
}  // namespace shoal::test
