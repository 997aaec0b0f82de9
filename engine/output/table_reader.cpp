// CSV coefficient tables, read back.
#include <fmt/format.h>

#include <array>
#include <charconv>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <istream>
#include <optional>
#include <span>
#include <utility>

#include "core/input_file.h"
#include "output/coefficient_table.h"

namespace shoal {
namespace {

// Longer fields are not names or numbers but a sign that a closing quote is missing.
constexpr std::size_t kMaxFieldLength = std::size_t{1} << 16;

constexpr std::size_t kMaxFields = 8;

using Fields = std::span<const std::string>;  // of one row; until the next is read

// RFC 4180 rows. Line numbers count from 1; a row's is that of its first line.
class CsvRows {
 public:
  CsvRows(std::istream& stream, std::string name)
      : bytes_(*stream.rdbuf()), name_(std::move(name)) {
    skip_byte_order_mark();
  }

  // The next row that is not blank; empty at the end.
  Result<Fields> next() {
    while (bytes_.sgetc() != kEnd) {
      line_ = next_line_;
      SHOAL_RETURN_IF_ERROR(read_row());
      if (field_count_ > 1 || !fields_[0].empty()) return Fields(fields_.data(), field_count_);
    }
    return Fields();
  }

  [[nodiscard]] Error malformed(std::string what) const {
    return Error{ErrorCode::malformed, std::move(what), name_ + ":" + std::to_string(line_),
                 "a table written by shoal is read back as it is; was this one edited?"};
  }

 private:
  static constexpr int kEnd = std::char_traits<char>::eof();

  void skip_byte_order_mark() {
    constexpr int kMark[] = {0xEF, 0xBB, 0xBF};
    if (bytes_.sgetc() != kMark[0]) return;
    for (const int byte : kMark) {
      if (bytes_.sgetc() == byte) bytes_.sbumpc();
    }
  }

  Status read_row() {
    field_count_ = 0;
    while (true) {
      if (field_count_ == kMaxFields) return malformed("more than 8 columns");
      std::string& field = fields_[field_count_++];
      field.clear();
      SHOAL_RETURN_IF_ERROR(bytes_.sgetc() == '"' ? read_quoted(field) : read_plain(field));
      const int end = bytes_.sbumpc();
      if (end == ',') continue;
      if (end == '\r' && bytes_.sgetc() == '\n') bytes_.sbumpc();
      ++next_line_;
      return {};
    }
  }

  // Up to a comma, a line end or the end of the file, which is left to be read.
  Status read_plain(std::string& field) {
    for (int c = bytes_.sgetc(); c != kEnd && c != ',' && c != '\n' && c != '\r';
         c = bytes_.snextc()) {
      if (c == '"') return malformed("a quote inside a field that does not begin with one");
      SHOAL_RETURN_IF_ERROR(append(field, c));
    }
    return {};
  }

  Status read_quoted(std::string& field) {
    bytes_.sbumpc();
    while (true) {
      const int c = bytes_.sbumpc();
      if (c == kEnd) return malformed("the quote that opens a field is never closed");
      if (c == '"' && bytes_.sgetc() != '"') break;
      if (c == '"') bytes_.sbumpc();
      if (c == '\n') ++next_line_;
      SHOAL_RETURN_IF_ERROR(append(field, c));
    }
    const int after = bytes_.sgetc();
    if (after == kEnd || after == ',' || after == '\n' || after == '\r') return {};
    return malformed("text after a closing quote");
  }

  Status append(std::string& field, int c) {
    if (field.size() == kMaxFieldLength) {
      return malformed("a field of more than 64 KiB: a closing quote may be missing");
    }
    field += static_cast<char>(c);
    return {};
  }

  std::streambuf& bytes_;
  std::string name_;
  std::array<std::string, kMaxFields> fields_;
  std::size_t field_count_ = 0;
  int line_ = 1;
  int next_line_ = 1;
};

// The columns behind the names: l, m, r, g, b.
struct Row {
  std::string_view panorama;
  std::string_view variant;
  Quantity quantity = Quantity::radiance;
  int l = 0;
  int m = 0;
  std::array<double, kChannelCount> rgb{};
};

template <typename T>
std::optional<T> number_of(std::string_view text) {
  T value{};
  const auto [end, code] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (code != std::errc() || end != text.data() + text.size()) return std::nullopt;
  return value;
}

Result<Row> parse_row(const CsvRows& rows, Fields fields, VariantColumn variant) {
  const std::size_t names = variant == VariantColumn::present ? 2 : 1;
  if (fields.size() != names + 6) {
    return rows.malformed(fmt::format("{} columns, not {}", fields.size(), names + 6));
  }
  Row row;
  row.panorama = fields[0];
  if (variant == VariantColumn::present) row.variant = fields[1];
  const auto quantity = parse_quantity(fields[names]);
  if (!quantity) return rows.malformed(quantity.error().what);
  row.quantity = *quantity;
  const auto l = number_of<int>(fields[names + 1]);
  const auto m = number_of<int>(fields[names + 2]);
  if (!l || !m || *l < 0 || *l > kMaxDegree || std::abs(*m) > *l) {
    return rows.malformed(fmt::format("l={} m={} is no coefficient: 0 <= l <= {}, |m| <= l",
                                      fields[names + 1], fields[names + 2], kMaxDegree));
  }
  row.l = *l;
  row.m = *m;
  for (int c = 0; c < kChannelCount; ++c) {
    const std::string& field = fields[names + 3 + c];
    const auto value = number_of<double>(field);
    if (!value || !std::isfinite(*value)) {
      return rows.malformed(
          fmt::format("\"{}\" in column {} is not a finite number", field, "rgb"[c]));
    }
    row.rgb[c] = *value;
  }
  return row;
}

// Gathers rows into records.
class RecordBuilder {
 public:
  RecordBuilder(const CsvRows& rows, const std::function<Status(CoefficientRecord)>& take)
      : rows_(rows), take_(take) {}

  Status add(const Row& row) {
    const auto index = static_cast<std::size_t>(coefficient_index(row.l, row.m));
    if (index == 0) {
      SHOAL_RETURN_IF_ERROR(finish());
      begin(row);
    }
    SHOAL_RETURN_IF_ERROR(check_order(row, index));
    for (int c = 0; c < kChannelCount; ++c) {
      record_->coefficients.channels[c].push_back(row.rgb[c]);
    }
    record_->coefficients.degree = row.l;
    return {};
  }

  Status finish() {
    if (!record_) return {};
    const auto& coefficients = record_->coefficients;
    const int want = coefficient_count(coefficients.degree);
    const auto count = static_cast<int>(coefficients.channels[0].size());
    if (count != want) {
      return rows_.malformed(fmt::format(
          "{} \"{}\" ends after {} of the {} coefficients of degree {}", name_of(record_->quantity),
          record_->panorama, count, want, coefficients.degree));
    }
    CoefficientRecord record = *std::move(record_);
    record_.reset();
    return take_(std::move(record));
  }

 private:
  void begin(const Row& row) {
    record_.emplace(CoefficientRecord{std::string(row.panorama), std::string(row.variant),
                                      row.quantity, Coefficients(), Frame()});
    for (auto& channel : record_->coefficients.channels) channel.clear();
  }

  [[nodiscard]] Status check_order(const Row& row, std::size_t index) const {
    const bool same = record_ && record_->panorama == row.panorama &&
                      record_->variant == row.variant && record_->quantity == row.quantity;
    if (same && index == record_->coefficients.channels[0].size()) return {};
    return rows_.malformed(
        fmt::format("l={} m={} of {} \"{}\" does not follow the row before: each "
                    "record has its coefficients in the order l(l+1)+m from l=0",
                    row.l, row.m, name_of(row.quantity), row.panorama));
  }

  const CsvRows& rows_;
  const std::function<Status(CoefficientRecord)>& take_;
  std::optional<CoefficientRecord> record_;
};

Result<VariantColumn> parse_header(const CsvRows& rows, Fields fields) {
  std::string header;
  for (const auto& field : fields) header += (header.empty() ? "" : ",") + field;
  if (header == "panorama,variant,quantity,l,m,r,g,b") return VariantColumn::present;
  if (header == "panorama,quantity,l,m,r,g,b") return VariantColumn::absent;
  return rows.malformed(
      "not a coefficient table: the first row must be panorama,variant,quantity,l,m,r,g,b or "
      "panorama,quantity,l,m,r,g,b");
}

}  // namespace

Status read_csv_table(std::istream& stream, const std::string& name,
                      const std::function<Status(CoefficientRecord)>& take) {
  CsvRows rows(stream, name);
  SHOAL_ASSIGN_OR_RETURN(header, rows.next());
  SHOAL_ASSIGN_OR_RETURN(variant, parse_header(rows, header));
  RecordBuilder builder(rows, take);
  while (true) {
    SHOAL_ASSIGN_OR_RETURN(fields, rows.next());
    if (fields.empty()) return builder.finish();
    SHOAL_ASSIGN_OR_RETURN(row, parse_row(rows, fields, variant));
    SHOAL_RETURN_IF_ERROR(builder.add(row));
  }
}

Result<std::vector<CoefficientRecord>> read_csv_table(const std::filesystem::path& path) {
  // Says in shoal's words why a file cannot be opened; a stream does not know.
  SHOAL_ASSIGN_OR_RETURN(file, InputFile::open(path));
  std::ifstream stream(file.path(), std::ios::binary);
  if (!stream) return Error{ErrorCode::unreadable, "cannot be opened", file.path(), ""};
  std::vector<CoefficientRecord> records;
  SHOAL_RETURN_IF_ERROR(read_csv_table(stream, file.path(), [&](CoefficientRecord record) {
    records.push_back(std::move(record));
    return Status();
  }));
  return records;
}

}  // namespace shoal
