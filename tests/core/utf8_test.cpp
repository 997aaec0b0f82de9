#include "core/utf8.h"

#include <gtest/gtest.h>

#include <string>

namespace shoal {
namespace {

using std::string_literals::operator""s;

// The first and the last code point of each length, by RFC 3629, section 3, and those beside the
// surrogates.
TEST(Utf8, TakesWholeCharacters) {
  for (const std::string& good :
       {"\0"s, "a"s, "\x7f"s, "\xc2\x80"s, "\xdf\xbf"s, "\xe0\xa0\x80"s, "\xed\x9f\xbf"s,
        "\xee\x80\x80"s, "\xef\xbf\xbf"s, "\xf0\x90\x80\x80"s, "\xf4\x8f\xbf\xbf"s}) {
    EXPECT_EQ(utf8_character_at(good, 0), good);
    EXPECT_EQ(utf8_character_at("x" + good + "x", 1), good);
    // Cut short it is none, whatever follows.
    for (std::size_t length = 1; length < good.size(); ++length) {
      EXPECT_EQ(utf8_character_at(good.substr(0, length), 0), "");
      EXPECT_EQ(utf8_character_at(good.substr(0, length) + "a", 0), "");
    }
  }
}

TEST(Utf8, TakesNothingElse) {
  for (const std::string& bad :
       {"\x80"s, "\xbf"s, "\xc0\x80"s, "\xc1\xbf"s, "\xe0\x9f\xbf"s, "\xed\xa0\x80"s,
        "\xed\xbf\xbf"s, "\xf0\x8f\xbf\xbf"s, "\xf4\x90\x80\x80"s, "\xf5\x80\x80\x80"s, "\xff"s}) {
    EXPECT_EQ(utf8_character_at(bad, 0), "") << testing::PrintToString(bad);
  }
}

// Of the 2^11, 2^16 and 2^21 bit patterns of two, three and four bytes exactly the code points are
// characters: 0x80 to 0x7FF, 0x800 to 0xFFFF less 2048 surrogates, 0x10000 to 0x10FFFF.
TEST(Utf8, HasAsManyCharactersAsThereAreCodePoints) {
  std::size_t counts[5] = {};
  for (unsigned bits = 0; bits < 1u << 21; ++bits) {
    const char tail[] = {static_cast<char>(0x80 | (bits >> 12 & 63)),
                         static_cast<char>(0x80 | (bits >> 6 & 63)),
                         static_cast<char>(0x80 | (bits & 63))};
    std::string text(1, static_cast<char>(0xF0 | bits >> 18));
    counts[utf8_character_at(text.append(tail, 3), 0).size()] += 1;
    if (bits >= 1u << 16) continue;
    text.assign(1, static_cast<char>(0xE0 | bits >> 12));
    counts[utf8_character_at(text.append(tail + 1, 2), 0).size()] += 1;
    if (bits >= 1u << 11) continue;
    text.assign(1, static_cast<char>(0xC0 | bits >> 6));
    counts[utf8_character_at(text.append(tail + 2, 1), 0).size()] += 1;
  }
  EXPECT_EQ(counts[2], 0x800u - 0x80u);
  EXPECT_EQ(counts[3], 0x10000u - 0x800u - 2048u);
  EXPECT_EQ(counts[4], 0x110000u - 0x10000u);
}

}  // namespace
}  // namespace shoal
