// Inflating is the inverse of compressing, and what is no zlib stream of the size asked for is
// refused. libdeflate is the judge: its verdict and its bytes are ours, whatever the bytes are.
#include "image/zlib_inflater.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>
#include <numeric>

#include "image/zlib_streams.h"

namespace shoal::test {
namespace {

struct Stream {
  Bytes packed;
  std::size_t size = 0;
};
using Outcomes = std::vector<std::optional<Bytes>>;

// Inflates the streams together, in the order of their numbers in `order`, each from a block of its
// own size so that a sanitizer sees what is read beyond it.
Outcomes inflate_together(const std::vector<Stream>& streams, const std::vector<std::size_t>& order,
                          ZlibInflater& inflater) {
  std::vector<ZlibInflater::Job> jobs;
  for (const std::size_t i : order) jobs.push_back({streams[i].packed, streams[i].size});
  Outcomes outcomes(streams.size());
  const std::size_t first_damaged =
      inflater.inflate(jobs, [&](std::size_t job, std::span<std::byte> bytes) {
        EXPECT_FALSE(outcomes[order[job]]) << "taken twice";
        outcomes[order[job]].emplace(bytes.begin(), bytes.end());
      });
  const auto missing =
      std::find_if(order.begin(), order.end(), [&](std::size_t i) { return !outcomes[i]; });
  EXPECT_EQ(first_damaged, static_cast<std::size_t>(missing - order.begin()));
  return outcomes;
}

// Alone, all together, and together in another order: partners must not matter.
Outcomes inflate_in_every_company(const std::vector<Stream>& streams, std::uint64_t seed) {
  static ZlibInflater inflater;
  std::vector<std::size_t> order(streams.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  Outcomes together = inflate_together(streams, order, inflater);
  RandomNumbers random(seed);
  for (std::size_t i = order.size(); i > 1; --i) {
    std::swap(order[i - 1], order[random.below(static_cast<int>(i))]);
  }
  EXPECT_TRUE(inflate_together(streams, order, inflater) == together);
  for (std::size_t i = 0; i < streams.size(); ++i) {
    EXPECT_TRUE(inflate_together({streams[i]}, {0}, inflater)[0] == together[i]) << i;
  }
  return together;
}

void expect_as_libdeflate(const std::vector<Stream>& streams, std::uint64_t seed) {
  const Outcomes outcomes = inflate_in_every_company(streams, seed);
  for (std::size_t i = 0; i < streams.size(); ++i) {
    EXPECT_TRUE(outcomes[i] == inflate_with_libdeflate(streams[i].packed, streams[i].size)) << i;
  }
}

// Noise of several widths, runs, near and far repetitions, and pieces of all of them.
std::vector<Bytes> made_bytes() {
  RandomNumbers random(1);
  std::vector<Bytes> all;
  for (const std::size_t size : {0, 1, 2, 3, 15, 64, 300, 5000, 70000, 200000}) {
    for (const int kind : {0, 1, 2, 3, 4, 5}) {
      Bytes bytes(size);
      for (std::size_t i = 0; i < size; ++i) {
        unsigned value = 0;
        if (kind == 0) value = random.bits() & 255;
        if (kind == 1) value = 128 + (random.bits() & random.bits() & 63);
        if (kind == 2) value = static_cast<unsigned>(i / 1000);
        if (kind == 3) value = "equirect"[i % 8] + (random.below(40) == 0);
        if (kind == 4) value = i < 32768 ? random.bits() & 255 : 0;
        if (kind == 4 && i >= 32768) value = std::to_integer<unsigned>(bytes[i - 32768]);
        if (kind == 5) value = i % 2000 < 1000 ? random.below(3) : random.bits() & 255;
        bytes[i] = static_cast<std::byte>(value);
      }
      all.push_back(std::move(bytes));
    }
  }
  return all;
}

TEST(ZlibInflater, UndoesEveryLevelAndStrategyOfLibdeflateAndZlib) {
  std::vector<Stream> streams;
  std::vector<const Bytes*> expected;
  const std::vector<Bytes> originals = made_bytes();
  for (const Bytes& bytes : originals) {
    for (int level = 0; level <= 12; level += bytes.size() > 100000 ? 3 : 1) {
      streams.push_back({compress_with_libdeflate(bytes, level), bytes.size()});
    }
    for (const int strategy : {Z_DEFAULT_STRATEGY, Z_FILTERED, Z_HUFFMAN_ONLY, Z_RLE, Z_FIXED}) {
      for (const int level : {0, 1, 6, 9}) {
        streams.push_back({compress_with_zlib(bytes, level, strategy), bytes.size()});
      }
      for (const int flush : {Z_PARTIAL_FLUSH, Z_SYNC_FLUSH, Z_FULL_FLUSH}) {
        streams.push_back({compress_with_zlib(bytes, 6, strategy, flush), bytes.size()});
      }
    }
    expected.resize(streams.size(), &bytes);
  }
  const Outcomes outcomes = inflate_in_every_company(streams, 2);
  for (std::size_t i = 0; i < streams.size(); ++i) {
    ASSERT_TRUE(outcomes[i]) << i;
    EXPECT_TRUE(*outcomes[i] == *expected[i]) << i;
  }
}

TEST(ZlibInflater, RefusesEveryOtherSizeAndEveryTruncation) {
  for (const Bytes& bytes : made_bytes()) {
    if (bytes.size() > 300) continue;
    for (const int level : {0, 1, 6, 12}) {
      const Bytes packed = compress_with_libdeflate(bytes, level);
      std::vector<Stream> streams;
      for (std::size_t size = 0; size <= bytes.size() + 3; ++size) {
        if (size != bytes.size()) streams.push_back({packed, size});
      }
      for (std::size_t length = 0; length < packed.size(); ++length) {
        const auto end = packed.begin() + static_cast<std::ptrdiff_t>(length);
        streams.push_back({Bytes(packed.begin(), end), bytes.size()});
      }
      const Outcomes outcomes = inflate_in_every_company(streams, 3);
      EXPECT_TRUE(outcomes == Outcomes(streams.size())) << bytes.size() << " level " << level;
    }
  }
}

// Cut where the fast loop is at work: the judge decides (a cut may leave a sound stream only if the
// checksum happens to be right).
TEST(ZlibInflater, JudgesTruncationsOfLongStreamsAsLibdeflateDoes) {
  const Bytes bytes = made_bytes()[9 * 6 + 5];
  const Bytes packed = compress_with_libdeflate(bytes, 6);
  std::vector<Stream> streams;
  for (std::size_t length = packed.size(); length > packed.size() / 2; length -= 1 + length / 97) {
    const auto end = packed.begin() + static_cast<std::ptrdiff_t>(length);
    streams.push_back({Bytes(packed.begin(), end), bytes.size()});
  }
  expect_as_libdeflate(streams, 4);
}

// Any change of a header or of the checksum is noticed, or does not matter to libdeflate either.
TEST(ZlibInflater, JudgesEveryHeaderAndChecksumAsLibdeflateDoes) {
  const Bytes packed = compress_with_libdeflate(made_bytes()[6 * 6 + 1], 6);
  std::vector<Stream> streams;
  for (int header = 0; header < 65536; ++header) {
    if (header % 31 > 1) continue;
    Stream stream{packed, 300};
    stream.packed[0] = static_cast<std::byte>(header >> 8);
    stream.packed[1] = static_cast<std::byte>(header);
    streams.push_back(std::move(stream));
  }
  for (std::size_t bit = 0; bit < 32; ++bit) {
    Stream stream{packed, 300};
    stream.packed[packed.size() - 1 - bit / 8] ^= static_cast<std::byte>(1 << (bit % 8));
    streams.push_back(std::move(stream));
  }
  expect_as_libdeflate(streams, 5);
}

// The blocks with a checksum that fits, as three streams: the size right, and wrong by one.
void add_streams(const Bytes& blocks, std::vector<Stream>& streams) {
  const WrappedBlocks wrapped = wrap_blocks(blocks);
  streams.push_back({wrapped.stream, wrapped.size});
  streams.push_back({wrapped.stream, wrapped.size + 1});
  if (wrapped.size > 0) streams.push_back({wrapped.stream, wrapped.size - 1});
}

TEST(ZlibInflater, JudgesMutatedBlocksAsLibdeflateDoes) {
  const std::vector<Bytes> originals = made_bytes();
  RandomNumbers random(6);
  int sound = 0;
  std::vector<Stream> streams;
  for (int trial = 0; trial < 40000; ++trial) {
    const Bytes& bytes = originals[6 * (5 + random.below(3)) + random.below(6)];
    Bytes blocks = trial % 2 ? compress_with_zlib(bytes, 6, trial / 2 % 5)
                             : compress_with_libdeflate(bytes, trial / 2 % 13);
    blocks.erase(blocks.begin(), blocks.begin() + 2);
    blocks.resize(blocks.size() - 4);
    // Near the beginning as a rule, where the codes are.
    const int range =
        static_cast<int>(trial % 3 == 0 ? blocks.size() : std::min<std::size_t>(blocks.size(), 80));
    for (int change = random.below(3); change >= 0; --change) {
      blocks[random.below(range)] ^= static_cast<std::byte>(1 << random.below(8));
    }
    // Old versions of libdeflate accept repetitions beyond the last length, which RFC 1951 and zlib
    // do not.
    if (complaint_of_zlib(blocks) == "invalid bit length repeat") continue;
    sound += wrap_blocks(blocks).is_sound;
    add_streams(blocks, streams);
    if (streams.size() < 50) continue;
    expect_as_libdeflate(streams, trial);
    streams.clear();
  }
  EXPECT_GT(sound, 5000);  // else this would compare little but refusals
}

// Codes drawn by lot, some of them incomplete or oversubscribed, before random bits.
TEST(ZlibInflater, JudgesRandomCodesAsLibdeflateDoes) {
  RandomNumbers random(7);
  int sound = 0;
  std::vector<Stream> streams;
  for (int trial = 0; trial < 20000; ++trial) {
    std::vector<int> literals = random_code(random, 257 + random.below(32), 2 + random.below(256));
    std::vector<int> distances = random_code(random, 2 + random.below(31), 2);
    if (random.below(2)) {
      const int symbols = 1 + random.below(32);
      distances = random_code(random, symbols, 1 + random.below(symbols));
    }
    const int oddity = random.below(8);
    if (oddity == 0) distances.assign(distances.size(), 0);
    if (oddity == 1) distances.assign(distances.size(), 0), distances[0] = 1;
    if (oddity == 2) distances.assign(distances.size(), 0), distances.back() = 2;
    if (oddity == 3) ++literals[random.below(static_cast<int>(literals.size()))] %= 16;
    if (oddity == 4) literals.assign(literals.size(), 0), literals[256] = 1;
    if (random.below(2))
      std::swap(literals[256], *std::max_element(literals.begin(), literals.end()));
    BitWriter writer;
    write_codes(literals, distances, writer);
    for (int i = random.below(400); i >= 0; --i) {
      writer.number(static_cast<unsigned>(random.bits() & random.bits() & 255), 8);
    }
    sound += wrap_blocks(writer.bytes()).is_sound;
    add_streams(writer.bytes(), streams);
    if (streams.size() < 50) continue;
    expect_as_libdeflate(streams, trial);
    streams.clear();
  }
  EXPECT_GT(sound, 2000);
}

// Fixed codes before random bits: among them the symbols 286, 287, 30 and 31, which have codes but
// no meaning in RFC 1951.
TEST(ZlibInflater, JudgesRandomBitsInFixedCodesAsLibdeflateDoes) {
  RandomNumbers random(8);
  std::vector<Stream> streams;
  for (int trial = 0; trial < 3000; ++trial) {
    BitWriter writer;
    writer.number(trial % 2, 1);
    writer.number(1, 2);
    for (int i = random.below(200); i >= 0; --i) {
      writer.number(static_cast<unsigned>(random.bits() & 255), 8);
    }
    add_streams(writer.bytes(), streams);
  }
  expect_as_libdeflate(streams, 9);
}

}  // namespace
}  // namespace shoal::test
