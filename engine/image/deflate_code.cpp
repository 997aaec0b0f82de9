#include "image/deflate_code.h"

#include <algorithm>
#include <bit>

namespace shoal {
namespace {

constexpr int kMaxSymbols = 288;

// How many symbols have a code of each length, and the symbols in the order of their codes.
struct SortedCode {
  std::array<std::uint16_t, kLongestCode + 1> count{};
  std::array<std::uint16_t, kMaxSymbols> symbols;

  explicit SortedCode(std::span<const std::uint8_t> lengths) {
    for (const std::uint8_t length : lengths) ++count[length];
    count[0] = 0;
    std::array<std::uint16_t, kLongestCode + 2> begin{};
    for (int length = 1; length <= kLongestCode; ++length) {
      begin[length + 1] = static_cast<std::uint16_t>(begin[length] + count[length]);
    }
    for (std::size_t symbol = 0; symbol < lengths.size(); ++symbol) {
      if (lengths[symbol] != 0) {
        symbols[begin[lengths[symbol]]++] = static_cast<std::uint16_t>(symbol);
      }
    }
  }
};

enum class Coverage { complete, one_symbol, none, bad };

// A code is complete if the shares 2^-length of the bit patterns add up to one.
Coverage coverage(const SortedCode& code) {
  unsigned patterns = 0;
  unsigned symbols = 0;
  for (int length = 1; length <= kLongestCode; ++length) {
    patterns += unsigned{code.count[length]} << (kLongestCode - length);
    symbols += code.count[length];
  }
  if (patterns == 1u << kLongestCode) return Coverage::complete;
  if (symbols == 0) return Coverage::none;
  return symbols == 1 && code.count[1] == 1 ? Coverage::one_symbol : Coverage::bad;
}

CodeEntry entry_of(unsigned symbol, int length, CodeUse use) {
  const auto bits = static_cast<unsigned>(length);
  if (use == CodeUse::plain || symbol < 256) return static_cast<CodeEntry>(symbol << 8 | bits);
  return static_cast<CodeEntry>((symbol - 256) << 8 | kNoLiteral | bits);
}

// The canonical code that follows `code` among those of `length` bits. Streams hold codes with the
// first bit lowest, so one is added at the top and the carry runs downwards.
unsigned next_code(unsigned code, int length) {
  const unsigned zeros = ~code & ((1u << length) - 1);
  if (zeros == 0) return 0;
  const unsigned top = std::bit_floor(zeros);
  return (code & (top - 1)) | top;
}

}  // namespace

bool build_code_table(std::span<const std::uint8_t> lengths, int root_bits, CodeUse use,
                      CodeEntry* table) {
  const SortedCode code_book(lengths);
  const std::size_t root_size = std::size_t{1} << root_bits;
  const Coverage covered = coverage(code_book);
  if (covered == Coverage::bad) return false;
  if (covered != Coverage::complete) {
    const unsigned symbol = covered == Coverage::none ? 0 : code_book.symbols[0];
    std::fill_n(table, root_size, entry_of(symbol, 1, use));
    return true;
  }

  // The table of codes up to `length` bits is the one of up to length - 1 bits twice over, with the
  // codes of `length` bits entered.
  const std::uint16_t* symbol = code_book.symbols.data();
  unsigned code = 0;
  for (int length = 1; length <= root_bits; ++length) {
    const std::size_t period = std::size_t{1} << (length - 1);
    std::copy_n(table, period, table + period);
    for (int i = 0; i < code_book.count[length]; ++i) {
      table[code] = entry_of(*symbol++, length, use);
      code = next_code(code, length);
    }
  }

  const unsigned root_mask = static_cast<unsigned>(root_size) - 1;
  const std::size_t subtable_size = std::size_t{1} << (kLongestCode - root_bits);
  unsigned prefix = root_mask + 1;  // none yet
  unsigned subtables = 0;
  for (int length = root_bits + 1; length <= kLongestCode; ++length) {
    for (int i = 0; i < code_book.count[length]; ++i) {
      if ((code & root_mask) != prefix) {
        prefix = code & root_mask;
        table[prefix] = static_cast<CodeEntry>(subtables++ << 8 | kNoLiteral | kIsLink);
      }
      CodeEntry* subtable = table + root_size + (subtables - 1) * subtable_size;
      const CodeEntry entry = entry_of(*symbol++, length, use);
      const std::size_t step = std::size_t{1} << (length - root_bits);
      for (std::size_t at = code >> root_bits; at < subtable_size; at += step) subtable[at] = entry;
      code = next_code(code, length);
    }
  }
  return true;
}

}  // namespace shoal
