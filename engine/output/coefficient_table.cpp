#include "output/coefficient_table.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "output/hashed_file.h"
#include "output/table_formats.h"

namespace shoal {
namespace {

class TextTable : public TableWriter {
 public:
  TextTable(std::unique_ptr<TextFormat> format, TextSink sink)
      : format_(std::move(format)), sink_(std::move(sink)) {
    format_->begin(buffer_);
  }

  TextTable(std::unique_ptr<TextFormat> format, HashedFile file)
      : format_(std::move(format)), file_(std::move(file)) {
    format_->begin(buffer_);
  }

  Status append(const CoefficientRecord& record) override {
    SHOAL_RETURN_IF_ERROR(check_record(record));
    format_->record(buffer_, record);
    return buffer_.size() < kTableBufferSize ? Status() : drain();
  }

  Result<std::vector<WrittenFile>> commit() override {
    format_->end(buffer_);
    SHOAL_RETURN_IF_ERROR(drain());
    if (!file_) return std::vector<WrittenFile>();
    SHOAL_ASSIGN_OR_RETURN(written, file_->commit());
    return std::vector<WrittenFile>{std::move(written)};
  }

 private:
  Status drain() {
    Status status = file_ ? file_->write(buffer_) : sink_(buffer_);
    buffer_.clear();
    return status;
  }

  std::unique_ptr<TextFormat> format_;
  TextSink sink_;
  std::optional<HashedFile> file_;
  std::string buffer_;
};

std::unique_ptr<TextFormat> make_text_format(TableFormat format, VariantColumn variant) {
  return format == TableFormat::csv ? make_csv_format(variant) : make_json_format(variant);
}

// The index of the first coefficient of `channel` that is not finite, or its size.
std::size_t first_not_finite(const std::vector<double>& channel) {
  const auto found =
      std::find_if(channel.begin(), channel.end(), [](double x) { return !std::isfinite(x); });
  return static_cast<std::size_t>(found - channel.begin());
}

}  // namespace

bool all_finite(const Coefficients& coefficients) {
  return std::all_of(
      coefficients.channels.begin(), coefficients.channels.end(),
      [](const auto& channel) { return first_not_finite(channel) == channel.size(); });
}

Status check_record(const CoefficientRecord& record) {
  const auto count = static_cast<std::size_t>(coefficient_count(record.coefficients.degree));
  for (int c = 0; c < kChannelCount; ++c) {
    const auto& channel = record.coefficients.channels[c];
    if (channel.size() != count) {
      return Error{ErrorCode::internal,
                   fmt::format("degree {} with {} coefficients in a channel, not {}",
                               record.coefficients.degree, channel.size(), count),
                   record.panorama, "please report this"};
    }
    const std::size_t i = first_not_finite(channel);
    if (i == count) continue;
    const int l = static_cast<int>(std::sqrt(static_cast<double>(i)));
    const int m = static_cast<int>(i) - l * (l + 1);
    return Error{ErrorCode::pixels,
                 fmt::format("its {} coefficient l={} m={} in {} is {}, and tables hold finite "
                             "numbers only",
                             name_of(record.quantity), l, m, "rgb"[c], channel[i]),
                 record.panorama, "look at its pixels, exposure, scale and colour matrix"};
  }
  return {};
}

std::string_view name_of(TableFormat format) {
  switch (format) {
    case TableFormat::csv:
      return "csv";
    case TableFormat::json:
      return "json";
    case TableFormat::npy:
      return "npy";
  }
  return "";
}

Result<std::unique_ptr<TableWriter>> create_table(TableFormat format,
                                                  const std::filesystem::path& path,
                                                  VariantColumn variant) {
  if (format == TableFormat::npy) return create_npy_table(path);
  SHOAL_ASSIGN_OR_RETURN(file, HashedFile::create(path));
  return std::unique_ptr<TableWriter>(
      std::make_unique<TextTable>(make_text_format(format, variant), std::move(file)));
}

Result<std::unique_ptr<TableWriter>> stream_table(TableFormat format, TextSink sink,
                                                  VariantColumn variant) {
  if (format == TableFormat::npy) {
    return Error{ErrorCode::usage, "an npy table cannot be streamed: its header holds the count",
                 "", "use csv or json"};
  }
  return std::unique_ptr<TableWriter>(
      std::make_unique<TextTable>(make_text_format(format, variant), std::move(sink)));
}

}  // namespace shoal
