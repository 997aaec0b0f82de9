// Coefficient tables: what shoal writes and what the viz program and others read.
//
// A table is a sequence of records in the order in which they are appended. It holds nothing that
// depends on time, threads or the machine: the same records give the same bytes.
//
// CSV   `panorama,variant,quantity,l,m,r,g,b`, one row a coefficient in index order, RFC 4180
//       quoting, "\n" line ends. `shoal project` leaves the variant column out.
// JSON  one object, one line a record:
//         {"schema": "shoal/coefficients", "version": 1,
//          "conventions": {basis, index, colour, channels, frame, quantities},
//          "records": [{"panorama", "variant", "quantity", "frame", "degree",
//                       "coefficients": [[r, g, b], ... index order]}, ...]}
//       A panorama's name that is not UTF-8 is shown with U+FFFD for the bytes at fault, and its
//       bytes stand in "panorama_hex" beside it (variants likewise).
// NPY   NumPy format 1.0, float64 little-endian, C order, (N, (L+1)^2, 3), and beside it
//       NAME.names.csv: `index,panorama,variant,quantity`. All records have one degree.
//
// Numbers are written like C's "%.17g", so they read back as the same double, -0 included (JSON
// says -0.0, since readers take -0 for an integer). A number that is not finite is an error: no
// table holds one.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <iosfwd>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "core/result.h"
#include "sphere/coefficients.h"
#include "sphere/frame.h"
#include "sphere/irradiance.h"

namespace shoal {

struct CoefficientRecord {
  std::string panorama;
  std::string variant;  // empty where the table has no such column
  Quantity quantity = Quantity::radiance;
  Coefficients coefficients;
  Frame frame;  // that they are given in; only JSON tells it, and what CSV gives back is native

  friend bool operator==(const CoefficientRecord&, const CoefficientRecord&) = default;
};

enum class TableFormat { csv, json, npy };

enum class VariantColumn {
  present,  // tables of `shoal run`
  absent,   // what `shoal project` prints
};

struct WrittenFile {
  std::filesystem::path path;
  std::string content_hash;  // as of ContentHasher
  std::uint64_t size = 0;
};

// Takes records one at a time and keeps none of them.
class TableWriter {
 public:
  virtual ~TableWriter() = default;

  // Errors: pixels (a coefficient is not finite), usage (npy: another degree than the records
  // before), write_failed. After an error the table must be given up.
  virtual Status append(const CoefficientRecord& record) = 0;

  // Ends the table and gives its files their final names; without it they never appear.
  // Returns the files written, none for a table that went to a sink.
  virtual Result<std::vector<WrittenFile>> commit() = 0;
};

// A table in a file that appears whole or not at all. The names file of an npy table takes the
// place of its extension: coefficients.npy, coefficients.names.csv; it appears just before.
Result<std::unique_ptr<TableWriter>> create_table(TableFormat format,
                                                  const std::filesystem::path& path,
                                                  VariantColumn variant);

using TextSink = std::function<Status(std::string_view)>;

// A table that goes to `sink` piece by piece, for standard output. Errors: usage (npy).
Result<std::unique_ptr<TableWriter>> stream_table(TableFormat format, TextSink sink,
                                                  VariantColumn variant);

[[nodiscard]] std::string_view name_of(TableFormat format);

// Whether all coefficients can stand in a table.
[[nodiscard]] bool all_finite(const Coefficients& coefficients);

// Hands the records of a CSV table to `take`, one at a time, in their order; stops at its first
// error. Both forms are read, with "\n" or "\r\n" line ends. Errors: malformed, `where` is
// name:line; a record must have all coefficients of its degree in index order.
Status read_csv_table(std::istream& stream, const std::string& name,
                      const std::function<Status(CoefficientRecord)>& take);

// All records of a CSV table. Errors: not_found, unreadable, malformed.
Result<std::vector<CoefficientRecord>> read_csv_table(const std::filesystem::path& path);

}  // namespace shoal
