#include "output/text_quoting.h"

#include <gtest/gtest.h>

namespace shoal {
namespace {

using namespace std::string_literals;

TEST(CsvQuoted, QuotesOnlyWhereRfc4180AsksForIt) {
  EXPECT_EQ(csv_quoted("studio/north light"), "studio/north light");
  EXPECT_EQ(csv_quoted(""), "");
  EXPECT_EQ(csv_quoted("a,b"), "\"a,b\"");
  EXPECT_EQ(csv_quoted("say \"hi\""), "\"say \"\"hi\"\"\"");
  EXPECT_EQ(csv_quoted("two\nlines"), "\"two\nlines\"");
  EXPECT_EQ(csv_quoted("cr\r"), "\"cr\r\"");
  EXPECT_EQ(csv_quoted("\xff\xfe"), "\xff\xfe");
}

TEST(JsonQuoted, EscapesWhatRfc8259AsksFor) {
  EXPECT_EQ(json_quoted("plain"), "\"plain\"");
  EXPECT_EQ(json_quoted("a\"b\\c/d"), "\"a\\\"b\\\\c/d\"");
  EXPECT_EQ(json_quoted("\n\r\t"), "\"\\n\\r\\t\"");
  EXPECT_EQ(json_quoted("\x01\x1f\x7f"), "\"\\u0001\\u001f\x7f\"");
  EXPECT_EQ(json_quoted("z\0z"s), "\"z\\u0000z\"");
}

// Each bad byte becomes one U+FFFD, EF BF BD; good characters around it stay.
TEST(JsonQuoted, ReplacesBytesThatAreNotUtf8) {
  EXPECT_EQ(json_quoted("gr\xc3\xbc\xc3\x9f"), "\"gr\xc3\xbc\xc3\x9f\"");
  EXPECT_EQ(json_quoted("a\xff"
                        "b"),
            "\"a\xEF\xBF\xBD"
            "b\"");
  EXPECT_EQ(json_quoted("\xc3"), "\"\xEF\xBF\xBD\"");
  EXPECT_EQ(json_quoted("\xed\xa0\x80"), "\"\xEF\xBF\xBD\xEF\xBF\xBD\xEF\xBF\xBD\"");
}

// The borders of the well-formed byte sequences, Unicode 15, table 3-7, both sides of each.
TEST(Utf8, AcceptsExactlyTheWellFormedSequences) {
  for (const auto& good :
       {"\x7f"s, "\xc2\x80"s, "\xdf\xbf"s, "\xe0\xa0\x80"s, "\xed\x9f\xbf"s, "\xee\x80\x80"s,
        "\xef\xbf\xbf"s, "\xf0\x90\x80\x80"s, "\xf4\x8f\xbf\xbf"s}) {
    EXPECT_EQ(utf8_length_at(good, 0), good.size()) << hexadecimal(good);
    EXPECT_TRUE(is_utf8(good + "x" + good)) << hexadecimal(good);
  }
  for (const auto& bad : {"\x80"s, "\xbf"s, "\xc0\xaf"s, "\xc1\xbf"s, "\xc2"s, "\xc2\x41"s,
                          "\xe0\x9f\xbf"s, "\xe1\x80"s, "\xed\xa0\x80"s, "\xf0\x8f\xbf\xbf"s,
                          "\xf1\x80\x80"s, "\xf4\x90\x80\x80"s, "\xf5\x80\x80\x80"s, "\xff"s}) {
    EXPECT_EQ(utf8_length_at(bad, 0), 0u) << hexadecimal(bad);
    EXPECT_FALSE(is_utf8("x" + bad)) << hexadecimal(bad);
  }
}

TEST(Hexadecimal, TwoDigitsAByte) { EXPECT_EQ(hexadecimal("\0\x0f\xff\x61"s), "000fff61"); }

}  // namespace
}  // namespace shoal
