// Tables as one array of NumPy's.
#include <fmt/format.h>

#include <bit>
#include <span>
#include <utility>

#include "core/atomic_file.h"
#include "core/content_hash.h"
#include "output/hashed_file.h"
#include "output/npy_format.h"
#include "output/table_formats.h"
#include "output/text_quoting.h"

namespace shoal {
namespace {

static_assert(std::endian::native == std::endian::little,
              "arrays are written as they lie in memory, and the header says '<f8'");

std::string table_header(std::uint64_t records, int coefficients) {
  return npy_header("<f8", fmt::format("({}, {}, {})", records, coefficients, kChannelCount));
}

class NpyTable : public TableWriter {
 public:
  NpyTable(std::filesystem::path path, AtomicFile array, HashedFile names)
      : path_(std::move(path)), array_(std::move(array)), names_(std::move(names)) {
    numbers_text_ = table_header(0, 0);
  }

  Status append(const CoefficientRecord& record) override {
    SHOAL_RETURN_IF_ERROR(check_record(record));
    if (count_ == 0) degree_ = record.coefficients.degree;
    if (record.coefficients.degree != degree_) {
      return Error{ErrorCode::usage,
                   fmt::format("is of degree {}, the records before of degree {}: an npy table is "
                               "one array and holds one degree",
                               record.coefficients.degree, degree_),
                   record.panorama, "give all panoramas the same degree, or write csv or json"};
    }
    append_numbers(record.coefficients);
    SHOAL_RETURN_IF_ERROR(
        names_.write(fmt::format("{},{},{},{}\n", count_++, csv_quoted(record.panorama),
                                 csv_quoted(record.variant), name_of(record.quantity))));
    return numbers_text_.size() < kTableBufferSize ? Status() : drain();
  }

  Result<std::vector<WrittenFile>> commit() override {
    SHOAL_RETURN_IF_ERROR(drain());
    const std::string header = table_header(count_, count_ == 0 ? 0 : coefficient_count(degree_));
    SHOAL_RETURN_IF_ERROR(array_.write_at(0, std::as_bytes(std::span(header))));
    SHOAL_ASSIGN_OR_RETURN(names, names_.commit());
    SHOAL_RETURN_IF_ERROR(array_.commit());
    // The header came last, so the hash cannot be gathered on the way.
    SHOAL_ASSIGN_OR_RETURN(hash, hash_file(path_));
    return std::vector<WrittenFile>{{path_, std::move(hash), size_}, std::move(names)};
  }

 private:
  void append_numbers(const Coefficients& coefficients) {
    const auto& [red, green, blue] = coefficients.channels;
    for (std::size_t i = 0; i < red.size(); ++i) {
      const double rgb[kChannelCount] = {red[i], green[i], blue[i]};
      numbers_text_.append(reinterpret_cast<const char*>(rgb), sizeof rgb);
    }
  }

  Status drain() {
    size_ += numbers_text_.size();
    SHOAL_RETURN_IF_ERROR(array_.write(numbers_text_));
    numbers_text_.clear();
    return {};
  }

  std::filesystem::path path_;
  AtomicFile array_;
  HashedFile names_;
  std::string numbers_text_;
  std::uint64_t count_ = 0;
  std::uint64_t size_ = 0;
  int degree_ = 0;
};

}  // namespace

Result<std::unique_ptr<TableWriter>> create_npy_table(const std::filesystem::path& path) {
  auto names_path = path;
  names_path.replace_extension(".names.csv");
  SHOAL_ASSIGN_OR_RETURN(array, AtomicFile::create(path));
  SHOAL_ASSIGN_OR_RETURN(names, HashedFile::create(names_path));
  SHOAL_RETURN_IF_ERROR(names.write("index,panorama,variant,quantity\n"));
  return std::unique_ptr<TableWriter>(
      std::make_unique<NpyTable>(path, std::move(array), std::move(names)));
}

}  // namespace shoal
