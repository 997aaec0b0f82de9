// The prefix code of a PIZ chunk: which bits stand for which of 65536 symbols, or for a run.
//
// As the OpenEXR library's PIZ compressor writes it: each symbol's length in 6 bits, 0 where it
// does not occur, 59 to 62 for 2 to 5 symbols that do not occur, 63 and 8 more bits n for n + 6 of
// them. The codes follow from the lengths: among codes of a length they grow with the symbol, and
// shorter codes, filled up with zeros, are greater than longer ones. Bits are read from the top of
// bytes.
#pragma once

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <optional>
#include <span>
#include <vector>

namespace shoal {

// Bytes as a string of bits, which goes on with zeros after their end.
class BitString {
 public:
  static constexpr int kFetched = 57;  // bits, at the least, that one fetch gives

  explicit BitString(std::span<const std::byte> bytes) : bytes_(bytes) {}

  [[nodiscard]] std::uint64_t size() const { return std::uint64_t{8} * bytes_.size(); }
  // The bits from `position` on, at the top of the result; those below kFetched may be wrong.
  // Precondition: position + 64 <= size().
  [[nodiscard]] std::uint64_t fetch(std::uint64_t position) const {
    std::uint64_t word = 0;
    std::memcpy(&word, bytes_.data() + (position >> 3), sizeof word);
    return __builtin_bswap64(word) << (position & 7);
  }
  // The 64 bits from `position` on, wherever that is.
  [[nodiscard]] std::uint64_t at(std::uint64_t position) const {
    const std::uint64_t byte = position >> 3;
    if (byte + 9 > bytes_.size()) return near_end(position);
    return fetch(position) |
           std::to_integer<std::uint64_t>(bytes_[byte + 8]) >> (8 - (position & 7));
  }

 private:
  [[nodiscard]] std::uint64_t near_end(std::uint64_t position) const;

  std::span<const std::byte> bytes_;
};

class ExrHuffmanCode {
 public:
  // Codes up to this length are looked up. 2^12 entries leave half of a first-level cache to the
  // rest. (11 are slower by a twentieth, 13 no faster.)
  static constexpr int kTableBits = 12;
  static constexpr int kLongest = 58;

  // What the next kTableBits bits begin with. A symbol: symbol << 16 | length. Otherwise `special`
  // with no length: a run of `entry >> 16` bits, or, where that is 0, a longer code.
  using Entry = std::uint32_t;
  static constexpr Entry kSpecial = 0x100;

  struct Code {
    unsigned length = 0;
    bool is_run = false;
    std::uint16_t symbol = 0;  // unless it is a run
  };

  // Takes the lengths of the symbols [first, last] from the front of `packed`; `last` stands for a
  // run. Returns how many bytes that took, or nothing when the lengths make no complete prefix
  // code, in which every string of bits begins with exactly one code: no other is ever written.
  std::optional<std::size_t> read(std::span<const std::byte> packed, std::uint32_t first,
                                  std::uint32_t last);

  [[nodiscard]] const Entry* table() const { return table_.data(); }
  // The code that the 64 bits begin with.
  [[nodiscard]] Code code_of(std::uint64_t bits) const {
    const Entry entry = table_[bits >> (64 - kTableBits)];
    if ((entry & kSpecial) == 0) {
      return {entry & 0xff, false, static_cast<std::uint16_t>(entry >> 16)};
    }
    return entry >> 16 ? Code{entry >> 16, true, 0} : long_code_of(bits);
  }

 private:
  struct Length {
    std::uint32_t symbol;
    std::uint32_t length;
  };
  std::optional<std::size_t> read_lengths(std::span<const std::byte> packed, std::uint32_t first,
                                          std::uint32_t last);
  bool assign_codes();
  void sort_symbols();
  void fill_table();
  [[nodiscard]] Code long_code_of(std::uint64_t bits) const;

  std::vector<Length> lengths_;         // of the symbols that occur, by symbol
  std::vector<std::uint32_t> symbols_;  // by length, then by symbol
  std::uint32_t run_symbol_ = 0;
  // By length: how many codes, the least of them, where their symbols begin in symbols_.
  std::array<std::uint32_t, kLongest + 2> counts_{};
  std::array<std::uint64_t, kLongest + 2> least_{};
  std::array<std::uint32_t, kLongest + 2> begins_{};
  std::array<Entry, std::size_t{1} << kTableBits> table_{};
};

}  // namespace shoal
