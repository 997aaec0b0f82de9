#include "image/exr_huffman_code.h"

#include <algorithm>

namespace shoal {
namespace {

constexpr unsigned kShortGap = 59;  // this, and the three above it: gaps of 2 to 5 symbols
constexpr unsigned kLongGap = 63;
constexpr unsigned kShortestLongGap = 6;

}  // namespace

std::uint64_t BitString::near_end(std::uint64_t position) const {
  const auto byte = [&](std::uint64_t i) {
    return i < bytes_.size() ? std::to_integer<std::uint64_t>(bytes_[i]) : 0;
  };
  const std::uint64_t first = position >> 3;
  std::uint64_t bits = 0;
  for (std::uint64_t i = first; i < first + 8; ++i) bits = bits << 8 | byte(i);
  return bits << (position & 7) | byte(first + 8) >> (8 - (position & 7));
}

std::optional<std::size_t> ExrHuffmanCode::read(std::span<const std::byte> packed,
                                                std::uint32_t first, std::uint32_t last) {
  const auto taken = read_lengths(packed, first, last);
  if (!taken || !assign_codes()) return std::nullopt;
  run_symbol_ = last;
  sort_symbols();
  fill_table();
  return taken;
}

std::optional<std::size_t> ExrHuffmanCode::read_lengths(std::span<const std::byte> packed,
                                                        std::uint32_t first, std::uint32_t last) {
  const BitString bits(packed);
  std::uint64_t position = 0;
  lengths_.clear();
  counts_.fill(0);
  std::uint32_t symbol = first;
  while (symbol <= last) {
    if (position >= bits.size()) return std::nullopt;
    const std::uint64_t next = bits.at(position);
    const auto length = static_cast<std::uint32_t>(next >> 58);
    position += 6;
    if (length < kShortGap) {
      if (length > 0) {
        lengths_.push_back({symbol, length});
        ++counts_[length];
      }
      ++symbol;
    } else if (length < kLongGap) {
      symbol += length - kShortGap + 2;
    } else {
      symbol += static_cast<std::uint32_t>(next >> 50 & 0xff) + kShortestLongGap;
      position += 8;
    }
  }
  if (symbol != last + 1 || position > bits.size()) return std::nullopt;
  return static_cast<std::size_t>((position + 7) / 8);
}

// From the longest codes, which begin with 0, to the shorter: what the codes of a length leave
// free begins, cut by a bit, with the least code of the next shorter length. A complete code leaves
// no half and ends with one empty code.
bool ExrHuffmanCode::assign_codes() {
  std::uint64_t least = 0;
  for (int length = kLongest; length > 0; --length) {
    least_[length] = least;
    least += counts_[length];
    if (least % 2 != 0) return false;
    least /= 2;
  }
  return least == 1;
}

void ExrHuffmanCode::sort_symbols() {
  std::uint32_t begin = 0;
  for (int length = 1; length <= kLongest; ++length) {
    begins_[length] = begin;
    begin += counts_[length];
  }
  symbols_.resize(lengths_.size());
  std::array<std::uint32_t, kLongest + 2> next = begins_;
  for (const Length& entry : lengths_) symbols_[next[entry.length]++] = entry.symbol;
}

// In the order of the codes: first all that are longer than the table is wide.
void ExrHuffmanCode::fill_table() {
  Entry* at = std::fill_n(table_.data(), least_[kTableBits], kSpecial);
  for (int length = kTableBits; length > 0; --length) {
    const std::size_t repeated = std::size_t{1} << (kTableBits - length);
    for (std::uint32_t i = 0; i < counts_[length]; ++i) {
      const std::uint32_t symbol = symbols_[begins_[length] + i];
      const auto bits = static_cast<Entry>(length);
      at = std::fill_n(at, repeated,
                       symbol == run_symbol_ ? bits << 16 | kSpecial : symbol << 16 | bits);
    }
  }
}

// Codes of a length, and all shorter ones, are not less than the least of that length.
ExrHuffmanCode::Code ExrHuffmanCode::long_code_of(std::uint64_t bits) const {
  unsigned length = kTableBits + 1;
  while (bits >> (64 - length) < least_[length]) ++length;
  const std::uint64_t rank = (bits >> (64 - length)) - least_[length];
  const std::uint32_t symbol = symbols_[begins_[length] + rank];
  return {length, symbol == run_symbol_, static_cast<std::uint16_t>(symbol)};
}

}  // namespace shoal
