// zlib streams that a test makes itself, and what libdeflate makes of them: the independent
// decoder.
#pragma once

#include <libdeflate.h>
#include <zlib.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "support/random_numbers.h"

namespace shoal::test {

using Bytes = std::vector<std::byte>;

inline Bytes compress_with_libdeflate(const Bytes& bytes, int level) {
  const std::unique_ptr<libdeflate_compressor, void (*)(libdeflate_compressor*)> compressor(
      libdeflate_alloc_compressor(level), libdeflate_free_compressor);
  Bytes packed(libdeflate_zlib_compress_bound(compressor.get(), bytes.size()));
  packed.resize(libdeflate_zlib_compress(compressor.get(), bytes.data(), bytes.size(),
                                         packed.data(), packed.size()));
  return packed;
}

// `flush` is done in the middle: Z_NO_FLUSH, or what ends a block there.
inline Bytes compress_with_zlib(Bytes bytes, int level, int strategy, int flush = Z_NO_FLUSH) {
  z_stream stream{};
  deflateInit2(&stream, level, Z_DEFLATED, 15, 8, strategy);
  Bytes packed(deflateBound(&stream, bytes.size()) + 64);
  stream.next_in = reinterpret_cast<Bytef*>(bytes.data());
  stream.next_out = reinterpret_cast<Bytef*>(packed.data());
  stream.avail_out = static_cast<uInt>(packed.size());
  stream.avail_in = static_cast<uInt>(bytes.size() / 2);
  deflate(&stream, flush);
  stream.avail_in += static_cast<uInt>(bytes.size() - bytes.size() / 2);
  deflate(&stream, Z_FINISH);
  packed.resize(stream.total_out);
  deflateEnd(&stream);
  return packed;
}

// What `packed` inflates to according to libdeflate, if it is `size` bytes.
inline std::optional<Bytes> inflate_with_libdeflate(const Bytes& packed, std::size_t size) {
  const std::unique_ptr<libdeflate_decompressor, void (*)(libdeflate_decompressor*)> inflater(
      libdeflate_alloc_decompressor(), libdeflate_free_decompressor);
  Bytes bytes(size);
  if (libdeflate_zlib_decompress(inflater.get(), packed.data(), packed.size(), bytes.data(), size,
                                 nullptr) != LIBDEFLATE_SUCCESS) {
    return std::nullopt;
  }
  return bytes;
}

// `blocks` as a zlib stream. Its checksum is that of what libdeflate makes of the blocks, so that a
// decoder has no other way to notice that they are damaged than libdeflate has.
struct WrappedBlocks {
  Bytes stream;
  std::size_t size = 0;  // of what it inflates to; 0 too if libdeflate finds it damaged
  bool is_sound = false;
};

inline WrappedBlocks wrap_blocks(const Bytes& blocks) {
  const std::unique_ptr<libdeflate_decompressor, void (*)(libdeflate_decompressor*)> inflater(
      libdeflate_alloc_decompressor(), libdeflate_free_decompressor);
  WrappedBlocks wrapped;
  Bytes bytes(std::size_t{1} << 18);
  std::size_t used = 0;
  wrapped.is_sound =
      libdeflate_deflate_decompress_ex(inflater.get(), blocks.data(), blocks.size(), bytes.data(),
                                       bytes.size(), &used, &wrapped.size) == LIBDEFLATE_SUCCESS;
  if (!wrapped.is_sound) {
    used = blocks.size();
    wrapped.size = 0;
  }
  const std::uint32_t sum = libdeflate_adler32(1, bytes.data(), wrapped.size);
  wrapped.stream.assign(blocks.begin(), blocks.begin() + static_cast<std::ptrdiff_t>(used));
  wrapped.stream.insert(wrapped.stream.begin(), {std::byte{0x78}, std::byte{0x9c}});
  for (const int shift : {24, 16, 8, 0}) {
    wrapped.stream.push_back(static_cast<std::byte>(sum >> shift));
  }
  return wrapped;
}

// Why zlib refuses blocks, or nothing.
inline std::string complaint_of_zlib(Bytes blocks) {
  z_stream stream{};
  inflateInit2(&stream, -15);
  Bytes bytes(std::size_t{1} << 18);
  stream.next_in = reinterpret_cast<Bytef*>(blocks.data());
  stream.avail_in = static_cast<uInt>(blocks.size());
  stream.next_out = reinterpret_cast<Bytef*>(bytes.data());
  stream.avail_out = static_cast<uInt>(bytes.size());
  inflate(&stream, Z_FINISH);
  std::string complaint = stream.msg ? stream.msg : "";
  inflateEnd(&stream);
  return complaint;
}

// Bits in the order of DEFLATE: numbers lowest bit first, codes highest bit first.
class BitWriter {
 public:
  void number(unsigned value, int bits) {
    for (int i = 0; i < bits; ++i) bit((value >> i) & 1);
  }
  void code(unsigned value, int bits) {
    for (int i = bits - 1; i >= 0; --i) bit((value >> i) & 1);
  }
  [[nodiscard]] const Bytes& bytes() const { return bytes_; }

 private:
  void bit(unsigned value) {
    if (filled_ % 8 == 0) bytes_.push_back(std::byte{0});
    bytes_.back() |= static_cast<std::byte>(value << (filled_++ % 8));
  }
  Bytes bytes_;
  std::size_t filled_ = 0;
};

// Begins a last block whose codes have these lengths. They are written one by one in a code that
// has 13 symbols of 4 bits and 6 of 5.
inline void write_codes(const std::vector<int>& literals, const std::vector<int>& distances,
                        BitWriter& to) {
  to.number(1, 1);
  to.number(2, 2);
  to.number(static_cast<unsigned>(literals.size()) - 257, 5);
  to.number(static_cast<unsigned>(distances.size()) - 1, 5);
  to.number(15, 4);
  for (const int symbol : {16, 17, 18, 0, 8, 7, 9, 6, 10, 5, 11, 4, 12, 3, 13, 2, 14, 1, 15}) {
    to.number(symbol < 13 ? 4 : 5, 3);
  }
  for (const auto* lengths : {&literals, &distances}) {
    for (const int length : *lengths) {
      if (length < 13) to.code(static_cast<unsigned>(length), 4);
      if (length >= 13) to.code(static_cast<unsigned>(length) + 13, 5);
    }
  }
}

// Lengths of a complete code of so many of the symbols, drawn by lot: leaf after leaf is split.
inline std::vector<int> random_code(RandomNumbers& random, int symbols, int used) {
  std::vector<int> leaves = {0};
  while (static_cast<int>(leaves.size()) < used) {
    int& leaf = leaves[random.below(static_cast<int>(leaves.size()))];
    if (leaf == 15) continue;
    leaves.push_back(++leaf);
  }
  std::vector<int> lengths(symbols);
  for (const int length : leaves) {
    int symbol = random.below(symbols);
    while (lengths[symbol] != 0) symbol = (symbol + 1) % symbols;
    lengths[symbol] = length;
  }
  return lengths;
}

}  // namespace shoal::test
