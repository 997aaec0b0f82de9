#include "core/utf8.h"

namespace shoal {
namespace {

// The bytes that may follow a character's first; those behind them are 80..BF.
struct SecondByte {
  unsigned low = 0x80;
  unsigned high = 0xBF;
};

SecondByte second_byte_of(unsigned first) {
  switch (first) {
    case 0xE0:
      return {.low = 0xA0};  // less would be overlong
    case 0xED:
      return {.high = 0x9F};  // more would be a surrogate
    case 0xF0:
      return {.low = 0x90};  // less would be overlong
    case 0xF4:
      return {.high = 0x8F};  // more would lie above U+10FFFF
    default:
      return {};
  }
}

std::size_t length_told_by(unsigned first) {
  if (first < 0x80) return 1;
  if (first < 0xC2 || first > 0xF4) return 0;
  return first < 0xE0 ? 2 : first < 0xF0 ? 3 : 4;
}

}  // namespace

std::string_view utf8_character_at(std::string_view text, std::size_t position) {
  const auto first = static_cast<unsigned char>(text[position]);
  const std::size_t length = length_told_by(first);
  if (position + length > text.size()) return {};
  SecondByte allowed = second_byte_of(first);
  for (std::size_t i = 1; i < length; ++i) {
    const auto byte = static_cast<unsigned char>(text[position + i]);
    if (byte < allowed.low || byte > allowed.high) return {};
    allowed = {};
  }
  return text.substr(position, length);
}

}  // namespace shoal
