#include "output/coefficient_table.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <limits>

#include "core/content_hash.h"
#include "output/python.h"
#include "output/table_formats.h"
#include "output/table_support.h"
#include "support/temporary_folder.h"

namespace shoal {
namespace {

using test::bytes_of;
using test::counting_record;
using test::nasty_record;
using test::streamed;
using test::TemporaryFolder;
using test::write_table;
using ::testing::AllOf;
using ::testing::HasSubstr;

constexpr double kInfinity = std::numeric_limits<double>::infinity();

TEST(JsonTable, ExactText) {
  auto second = counting_record("b\xff\"", "", Quantity::irradiance, 0);
  second.coefficients.channels = {{{0.1}, {-0.0}, {1e300}}};
  second.frame = *parse_frame("+z,-x,+y");
  EXPECT_EQ(
      streamed(TableFormat::json, VariantColumn::present,
               {counting_record("a", "soft", Quantity::radiance, 1), second}),
      R"({
"schema": "shoal/coefficients",
"version": 1,
"conventions": {
  "basis": "real, orthonormal over the unit sphere, without the Condon-Shortley phase",
  "index": "l*(l+1)+m, l = 0..degree, m = -l..l",
  "colour": "linear Rec.709",
  "channels": ["r", "g", "b"],
  "frame": "where the panorama's centre, right and up point",
  "quantities": {
    "radiance": "L_lm, the integral of L Y_lm over the sphere",
    "irradiance": "A_l L_lm with A_l of the clamped cosine: pi, 2pi/3, pi/4, 0, -pi/24, ...",
    "irradiance-over-pi": "A_l L_lm / pi"
  }
},
"records": [
{"panorama": "a", "variant": "soft", "quantity": "radiance", "frame": "-x,-y,+z", "degree": 1, "coefficients": [[1, 2, 3], [4, 5, 6], [7, 8, 9], [10, 11, 12]]},
)"
      "{\"panorama\": \"b\xEF\xBF\xBD\\\"\", \"panorama_hex\": \"62ff22\", \"variant\": \"\", "
      "\"quantity\": \"irradiance\", \"frame\": \"+z,-x,+y\", \"degree\": 0, \"coefficients\": "
      "[[0.10000000000000001, -0.0, 1.0000000000000001e+300]]}\n]\n}\n");
}

TEST(JsonTable, LeavesTheVariantOutForProject) {
  const std::string text = streamed(TableFormat::json, VariantColumn::absent,
                                    {counting_record("x", "no", Quantity::radiance, 0)});
  EXPECT_THAT(
      text, HasSubstr("{\"panorama\": \"x\", \"quantity\": \"radiance\", "
                      "\"frame\": \"-x,-y,+z\", \"degree\": 0, \"coefficients\": [[1, 2, 3]]}\n"));
}

TEST(JsonTable, PythonReadsTheSameBitsAndNames) {
  SHOAL_REQUIRE_PYTHON(python, "json");
  const TemporaryFolder folder;
  std::string every_byte;
  for (int byte = 1; byte < 256; ++byte) every_byte += static_cast<char>(byte);
  const std::vector<CoefficientRecord> records = {nasty_record(every_byte, 1, 8),
                                                  nasty_record("gr\xc3\xbc\xc3\x9f", 2, 3)};
  write_table(TableFormat::json, folder / "t.json", records);
  write_table(TableFormat::json, folder / "none.json", {});
  write_table(TableFormat::npy, folder / "bits.npy", {records[0]});
  const auto run = test::run_python(python, folder.path(), R"(
import json, struct
assert json.load(open("none.json", encoding="utf-8"))["records"] == []
table = json.load(open("t.json", encoding="utf-8"))
assert table["schema"] == "shoal/coefficients" and table["version"] == 1
first, second = table["records"]
assert bytes.fromhex(first["panorama_hex"]) == bytes(range(1, 256))
assert first["panorama"] == "".join(map(chr, range(1, 128))) + "\ufffd" * 128
assert second["panorama"] == "gr\u00fc\u00df" and "panorama_hex" not in second
assert (first["degree"], len(first["coefficients"])) == (8, 81)
numbers = [float(x) for rgb in first["coefficients"] for x in rgb]
raw = open("bits.npy", "rb").read()[128:]
assert struct.pack("<%dd" % len(numbers), *numbers) == raw
print("read")
)");
  EXPECT_EQ(run.status, 0) << run.output;
  EXPECT_EQ(run.output, "read\n");
}

TEST(NpyTable, HeaderIsAlignedAndSaysTheShape) {
  const TemporaryFolder folder;
  write_table(TableFormat::npy, folder / "t.npy",
              {counting_record("a", "", Quantity::radiance, 1),
               counting_record("b", "", Quantity::radiance, 1)});
  const std::string bytes = bytes_of(folder / "t.npy");
  const std::string start = std::string("\x93NUMPY\x01\x00\x76\x00", 10) +
                            "{'descr': '<f8', 'fortran_order': False, 'shape': (2, 4, 3), }";
  ASSERT_EQ(bytes.size(), 128u + 2 * 4 * 3 * sizeof(double));
  EXPECT_EQ(bytes.substr(0, start.size()), start);
  EXPECT_EQ(bytes.substr(start.size(), 127 - start.size()), std::string(127 - start.size(), ' '));
  EXPECT_EQ(bytes[127], '\n');
}

TEST(NpyTable, NumpyReadsTheSameBitsAndNames) {
  SHOAL_REQUIRE_PYTHON(python, "numpy");
  const TemporaryFolder folder;
  const std::vector<CoefficientRecord> records = {nasty_record("a,\"b\"", 1, 6),
                                                  nasty_record("c\nd", 2, 6)};
  write_table(TableFormat::npy, folder / "t.npy", records);
  write_table(TableFormat::npy, folder / "none.npy", {});
  // Written here in C order (record, index, channel) by the test itself.
  std::ofstream expected(folder / "expected.bin", std::ios::binary);
  for (const auto& record : records) {
    for (int i = 0; i < coefficient_count(6); ++i) {
      for (const auto& channel : record.coefficients.channels) {
        expected.write(reinterpret_cast<const char*>(&channel[i]), sizeof(double));
      }
    }
  }
  expected.close();
  const auto run = test::run_python(python, folder.path(), R"(
import csv, numpy
assert numpy.load("none.npy").shape == (0, 0, 3)
for mode in (None, "r"):
    table = numpy.load("t.npy", mmap_mode=mode)
    assert table.dtype == numpy.float64 and table.shape == (2, 49, 3), (table.dtype, table.shape)
    assert table.flags.c_contiguous
    assert table.tobytes() == open("expected.bin", "rb").read()
rows = list(csv.reader(open("t.names.csv", newline="")))
assert rows == [["index", "panorama", "variant", "quantity"],
                ["0", 'a,"b"', "v", "irradiance"], ["1", "c\nd", "v", "irradiance"]], rows
print("read")
)");
  EXPECT_EQ(run.status, 0) << run.output;
  EXPECT_EQ(run.output, "read\n");
}

TEST(NpyTable, RefusesASecondDegree) {
  const TemporaryFolder folder;
  auto table = create_table(TableFormat::npy, folder / "t.npy", VariantColumn::present);
  ASSERT_TRUE((*table)->append(counting_record("a", "", Quantity::radiance, 2)).ok());
  const auto status = (*table)->append(counting_record("b", "", Quantity::radiance, 3));
  ASSERT_FALSE(status.ok());
  EXPECT_EQ(status.error().code, ErrorCode::usage);
  EXPECT_EQ(status.error().where, "b");
  EXPECT_THAT(status.error().what, AllOf(HasSubstr("degree 3"), HasSubstr("degree 2")));
}

TEST(NpyTable, CannotBeStreamed) {
  const auto table = stream_table(
      TableFormat::npy, [](std::string_view) { return Status(); }, VariantColumn::present);
  ASSERT_FALSE(table.ok());
  EXPECT_EQ(table.error().code, ErrorCode::usage);
}

TEST(EveryTable, IsTheSameBytesTwiceAndTellsItsHash) {
  const TemporaryFolder folder;
  // More than the writers' buffers hold, so that they are emptied on the way.
  std::vector<CoefficientRecord> records;
  for (unsigned i = 0; i < 40; ++i) records.push_back(nasty_record(std::to_string(i), i, 40));
  for (const auto format : {TableFormat::csv, TableFormat::json, TableFormat::npy}) {
    const std::string name = "t." + std::string(name_of(format));
    const auto first = write_table(format, folder / ("1/" + name), records);
    const auto second = write_table(format, folder / ("2/" + name), records);
    ASSERT_EQ(first.size(), format == TableFormat::npy ? 2u : 1u);
    EXPECT_GT(first[0].size, kTableBufferSize);
    for (std::size_t i = 0; i < first.size(); ++i) {
      EXPECT_EQ(bytes_of(first[i].path), bytes_of(second[i].path)) << first[i].path;
      EXPECT_EQ(first[i].size, bytes_of(first[i].path).size()) << first[i].path;
      EXPECT_EQ(first[i].content_hash, hash_text(bytes_of(first[i].path))) << first[i].path;
    }
    if (format == TableFormat::npy) continue;
    EXPECT_EQ(bytes_of(first[0].path), streamed(format, VariantColumn::present, records));
  }
}

TEST(EveryTable, RefusesNumbersThatAreNotFiniteAndThenNeverAppears) {
  const TemporaryFolder folder;
  for (const auto format : {TableFormat::csv, TableFormat::json, TableFormat::npy}) {
    for (const double bad : {kInfinity, -kInfinity, std::nan("")}) {
      auto record = counting_record("studio", "", Quantity::irradiance, 2);
      EXPECT_TRUE(all_finite(record.coefficients));
      record.coefficients.channels[1][coefficient_index(2, -1)] = bad;
      EXPECT_FALSE(all_finite(record.coefficients));
      auto table = create_table(format, folder / "t", VariantColumn::present);
      const auto status = (*table)->append(record);
      ASSERT_FALSE(status.ok());
      EXPECT_EQ(status.error().code, ErrorCode::pixels);
      EXPECT_EQ(status.error().where, "studio");
      EXPECT_THAT(status.error().what, HasSubstr("irradiance coefficient l=2 m=-1 in g"));
    }
  }
  EXPECT_TRUE(std::filesystem::is_empty(folder.path()));
}

TEST(EveryTable, HandsOnTheSinksError) {
  auto table = stream_table(
      TableFormat::csv,
      [](std::string_view) {
        return Error{ErrorCode::write_failed, "closed pipe", "", ""};
      },
      VariantColumn::present);
  const auto written = (*table)->commit();
  ASSERT_FALSE(written.ok());
  EXPECT_EQ(written.error().code, ErrorCode::write_failed);
}

}  // namespace
}  // namespace shoal
