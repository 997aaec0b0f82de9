#include "output/coefficient_table.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <bit>
#include <cstdio>
#include <locale>
#include <sstream>

#include "output/table_support.h"
#include "sphere/linear_operations.h"
#include "support/temporary_folder.h"

namespace shoal {
namespace {

using test::counting_record;
using test::nasty_record;
using test::streamed;
using test::TemporaryFolder;
using test::write_table;
using ::testing::HasSubstr;

Result<std::vector<CoefficientRecord>> parse(const std::string& text) {
  std::istringstream stream(text);
  std::vector<CoefficientRecord> records;
  SHOAL_RETURN_IF_ERROR(read_csv_table(stream, "t.csv", [&](CoefficientRecord record) {
    records.push_back(std::move(record));
    return Status();
  }));
  return records;
}

// == takes -0 for 0; this does not.
void expect_same_bits(const CoefficientRecord& a, const CoefficientRecord& b) {
  EXPECT_EQ(a, b);
  for (int c = 0; c < kChannelCount; ++c) {
    for (std::size_t i = 0; i < a.coefficients.channels[c].size(); ++i) {
      EXPECT_EQ(std::bit_cast<std::uint64_t>(a.coefficients.channels[c][i]),
                std::bit_cast<std::uint64_t>(b.coefficients.channels[c][i]))
          << a.panorama << " channel " << c << " index " << i;
    }
  }
}

TEST(CsvTable, ExactText) {
  auto second = counting_record("b,\"c\"", "", Quantity::irradiance_over_pi, 0);
  second.coefficients.channels = {{{0.1}, {-0.0}, {1e-300}}};
  EXPECT_EQ(streamed(TableFormat::csv, VariantColumn::present,
                     {counting_record("a/b", "soft", Quantity::radiance, 1), second}),
            "panorama,variant,quantity,l,m,r,g,b\n"
            "a/b,soft,radiance,0,0,1,2,3\n"
            "a/b,soft,radiance,1,-1,4,5,6\n"
            "a/b,soft,radiance,1,0,7,8,9\n"
            "a/b,soft,radiance,1,1,10,11,12\n"
            "\"b,\"\"c\"\"\",,irradiance-over-pi,0,0,0.10000000000000001,-0,1e-300\n");
}

TEST(CsvTable, ExactTextWithoutVariants) {
  EXPECT_EQ(streamed(TableFormat::csv, VariantColumn::absent,
                     {counting_record("x.hdr", "", Quantity::irradiance, 0)}),
            "panorama,quantity,l,m,r,g,b\n"
            "x.hdr,irradiance,0,0,1,2,3\n");
}

// The promise is C's "%.17g", so C's own printf is the oracle.
TEST(CsvTable, NumbersAreThoseOfPrintf) {
  const auto record = nasty_record("n", 3, 20);
  std::string expected = "panorama,variant,quantity,l,m,r,g,b\n";
  for (int l = 0; l <= 20; ++l) {
    for (int m = -l; m <= l; ++m) {
      expected += "n,v,irradiance," + std::to_string(l) + "," + std::to_string(m);
      for (const auto& channel : record.coefficients.channels) {
        char digits[32];
        std::snprintf(digits, sizeof digits, ",%.17g", channel[coefficient_index(l, m)]);
        expected += digits;
      }
      expected += "\n";
    }
  }
  EXPECT_EQ(streamed(TableFormat::csv, VariantColumn::present, {record}), expected);
}

TEST(CsvTable, ReadsBackWithTheSameBits) {
  const std::vector<CoefficientRecord> records = {
      nasty_record("plain", 1, 10), nasty_record("comma, \"quote\"\nline\r\n", 2, 64),
      nasty_record("", 3, 0), nasty_record("bytes \xff\xfe", 4, 2), nasty_record("=1+1", 5, 3)};
  const auto back = parse(streamed(TableFormat::csv, VariantColumn::present, records));
  ASSERT_TRUE(back.ok()) << back.error().text();
  ASSERT_EQ(back->size(), records.size());
  for (std::size_t i = 0; i < records.size(); ++i) expect_same_bits(back->at(i), records[i]);
}

TEST(CsvTable, ReadsBackFromAFile) {
  const TemporaryFolder folder;
  const std::vector<CoefficientRecord> records = {nasty_record("a", 1, 2), nasty_record("b", 2, 4)};
  write_table(TableFormat::csv, folder / "deep/er/t.csv", records);
  const auto back = read_csv_table(folder / "deep/er/t.csv");
  ASSERT_TRUE(back.ok()) << back.error().text();
  EXPECT_EQ(*back, records);

  const auto missing = read_csv_table(folder / "none.csv");
  ASSERT_FALSE(missing.ok());
  EXPECT_EQ(missing.error().code, ErrorCode::not_found);
}

TEST(CsvTable, ReadsOtherLineEndsBlankLinesAndAByteOrderMark) {
  const auto back = parse(
      "\xEF\xBB\xBFpanorama,quantity,l,m,r,g,b\r\n\r\n"
      "a,radiance,0,0,1,2,3\r\n"
      "\n"
      "a,radiance,0,0,4,5,6");
  ASSERT_TRUE(back.ok()) << back.error().text();
  ASSERT_EQ(back->size(), 2u);
  EXPECT_EQ(back->at(1).coefficients.channels[2][0], 6.0);
  EXPECT_EQ(back->at(1).variant, "");
}

TEST(CsvTable, AHeaderAloneIsATableWithoutRecords) {
  const auto back = parse(streamed(TableFormat::csv, VariantColumn::present, {}));
  ASSERT_TRUE(back.ok());
  EXPECT_TRUE(back->empty());
}

struct BadTable {
  const char* text;
  const char* where;
  const char* what;
};

TEST(CsvTable, ErrorsNameFileAndLine) {
  const std::string head = "panorama,quantity,l,m,r,g,b\n";
  const BadTable cases[] = {
      {"a,radiance,0,0,1,2\n", "t.csv:2", "6 columns, not 7"},
      {"a,radiance,0,0,1,2,3,4\n", "t.csv:2", "8 columns, not 7"},
      {"a,radiance,0,0,1,2,3,4,5\n", "t.csv:2", "more than 8 columns"},
      {"a,light,0,0,1,2,3\n", "t.csv:2", "unknown quantity \"light\""},
      {"a,radiance,0,0,1,2,3\na,radiance,1,2,1,2,3\n", "t.csv:3", "l=1 m=2 is no coefficient"},
      {"a,radiance,x,0,1,2,3\n", "t.csv:2", "l=x m=0"},
      {"a,radiance,65,0,1,2,3\n", "t.csv:2", "0 <= l <= 64"},
      {"a,radiance,0,0,1,2,3z\n", "t.csv:2", "\"3z\" in column b"},
      {"a,radiance,0,0,,2,3\n", "t.csv:2", "\"\" in column r"},
      {"a,radiance,0,0,nan,2,3\n", "t.csv:2", "\"nan\" in column r is not a finite number"},
      {"a,radiance,0,0,1,-inf,3\n", "t.csv:2", "\"-inf\" in column g is not a finite number"},
      {"a,radiance,0,0,1,1e999,3\n", "t.csv:2", "\"1e999\" in column g is not a finite number"},
      {"a,radiance,1,0,1,2,3\n", "t.csv:2", "does not follow the row before"},
      {"a,radiance,0,0,1,2,3\nb,radiance,1,-1,1,2,3\n", "t.csv:3", "does not follow"},
      {"a,radiance,0,0,1,2,3\na,irradiance,1,-1,1,2,3\n", "t.csv:3", "does not follow"},
      {"a,radiance,0,0,1,2,3\na,radiance,1,-1,1,2,3\n", "t.csv:3", "ends after 2 of the 4"},
      {"\"a\nb\",radiance,0,0,1,2,3\nq\"q,radiance,0,0,1,2,3\n", "t.csv:4", "a quote inside"},
      {"\"a,radiance,0,0,1,2,3\n", "t.csv:2", "never closed"},
      {"\"a\"b,radiance,0,0,1,2,3\n", "t.csv:2", "text after a closing quote"},
  };
  for (const BadTable& bad : cases) {
    const auto back = parse(head + bad.text);
    ASSERT_FALSE(back.ok()) << bad.text;
    EXPECT_EQ(back.error().code, ErrorCode::malformed) << bad.text;
    EXPECT_EQ(back.error().where, bad.where) << bad.text;
    EXPECT_THAT(back.error().what, HasSubstr(bad.what)) << bad.text;
  }
  for (const char* text : {"", "a,b,c\n", "name,l,m,r,g,b\n"}) {
    const auto back = parse(text);
    ASSERT_FALSE(back.ok()) << text;
    EXPECT_EQ(back.error().where, "t.csv:1");
    EXPECT_THAT(back.error().what, HasSubstr("not a coefficient table"));
  }
}

// A table cut behind any line is an error or holds a prefix of the records, the last one perhaps
// cut to a lower degree: after (0,0) alone nothing tells degree 1 from degree 0.
TEST(CsvTable, ATableCutBehindALineYieldsOnlyWhatWasThere) {
  const std::vector<CoefficientRecord> records = {counting_record("a", "", Quantity::radiance, 1),
                                                  counting_record("b", "", Quantity::radiance, 1)};
  const std::string text = streamed(TableFormat::csv, VariantColumn::present, records);
  std::string counts;
  for (std::size_t end = text.find('\n'); end != std::string::npos;
       end = text.find('\n', end + 1)) {
    const auto back = parse(text.substr(0, end + 1));
    counts += back ? std::to_string(back->size()) : "-";
    if (!back) continue;
    for (std::size_t i = 0; i < back->size(); ++i) {
      const int degree = back->at(i).coefficients.degree;
      EXPECT_EQ(back->at(i).coefficients, truncate(records[i].coefficients, degree));
      EXPECT_EQ(back->at(i).panorama, records[i].panorama);
    }
  }
  EXPECT_EQ(counts, "01--12--2");
}

struct CommaPoint : std::numpunct<char> {
  char do_decimal_point() const override { return ','; }
  char do_thousands_sep() const override { return '.'; }
  std::string do_grouping() const override { return "\3"; }
};

TEST(CsvTable, IsIndependentOfTheLocale) {
  const auto record = nasty_record("n", 3, 4);
  const std::string expected = streamed(TableFormat::csv, VariantColumn::present, {record});
  const std::locale before =
      std::locale::global(std::locale(std::locale::classic(), new CommaPoint));
  const std::string text = streamed(TableFormat::csv, VariantColumn::present, {record});
  const auto back = parse(text);
  std::locale::global(before);
  EXPECT_EQ(text, expected);
  ASSERT_TRUE(back.ok());
  expect_same_bits(back->at(0), record);
}

}  // namespace
}  // namespace shoal
