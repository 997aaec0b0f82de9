// Tables that decode the Huffman codes of DEFLATE (RFC 1951, section 3.2).
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

// For what the fast loop consists of: it is compiled for two instruction sets, and its state must
// stay in registers.
#define SHOAL_INLINE __attribute__((always_inline)) inline

namespace shoal {

inline constexpr int kLongestCode = 15;  // bits; of the code of code lengths: 7

// What the next bits of a stream stand for, in 16 bits, so that the tables of four streams share a
// first-level cache:
//   bits 0-3   the code's length
//   bits 4-5   zero: with bit 7 clear, the low six bits are a shift count as they stand
//   bit 6      kIsLink: the code is longer than the table has bits; look further in a subtable
//   bit 7      kNoLiteral: a link, or of the code of literals and lengths a symbol above 255
//   bits 8-15  the literal, the symbol (literal/length code: its excess over 256), or the subtable
using CodeEntry = std::uint16_t;
inline constexpr CodeEntry kIsLink = 1 << 6;
inline constexpr CodeEntry kNoLiteral = 1 << 7;

constexpr unsigned code_length(CodeEntry entry) { return entry & 15u; }
constexpr unsigned payload(CodeEntry entry) { return entry >> 8; }

enum class CodeUse { literals_and_lengths, plain };

// Fills the first 2^root_bits elements of `table`, and subtables of 2^(15 - root_bits) elements
// behind them, from the lengths of the codes by symbol (0: unused). Where codes are longer than
// root_bits there are at most lengths.size() / 2 subtables, two codes at least in each.
// False for lengths that are no prefix code, or one that leaves bit patterns unused. As in zlib and
// libdeflate, two such codes pass all the same: a code of one symbol, one bit long, which both bits
// then stand for; and a code of no symbols, as which symbol 0 is read, one bit long.
[[nodiscard]] bool build_code_table(std::span<const std::uint8_t> lengths, int root_bits,
                                    CodeUse use, CodeEntry* table);

// The table of a code, with room for so many subtables.
template <int subtables, int root_bits>
struct CodeTable {
  static constexpr int kRootBits = root_bits;
  static constexpr std::size_t kRootSize = std::size_t{1} << root_bits;
  static constexpr std::uint64_t kRootMask = kRootSize - 1;
  static constexpr std::size_t kSubtableSize = std::size_t{1} << (kLongestCode - root_bits);

  [[nodiscard]] bool build(std::span<const std::uint8_t> lengths, CodeUse use) {
    return build_code_table(lengths, root_bits, use, entries.data());
  }
  // The entry of the code that `bits` begin with, no link.
  [[nodiscard]] SHOAL_INLINE CodeEntry find(std::uint64_t bits) const {
    const CodeEntry entry = entries[bits & kRootMask];
    return entry & kIsLink ? follow(entry, bits) : entry;
  }
  [[nodiscard]] SHOAL_INLINE CodeEntry follow(CodeEntry link, std::uint64_t bits) const {
    return entries[kRootSize + payload(link) * kSubtableSize +
                   ((bits >> root_bits) & (kSubtableSize - 1))];
  }

  std::array<CodeEntry, kRootSize + subtables * kSubtableSize> entries{};
};

}  // namespace shoal
