// Any text as a CSV table: records or an error, never a crash; and what was read once reads back as
// the same records after it is written.
#include <sstream>
#include <vector>

#include "fuzz/fuzz_input.h"
#include "output/coefficient_table.h"

namespace shoal::test {
namespace {

Result<std::vector<CoefficientRecord>> read(const std::string& text) {
  std::istringstream stream(text);
  std::vector<CoefficientRecord> records;
  SHOAL_RETURN_IF_ERROR(read_csv_table(stream, "table.csv", [&](CoefficientRecord record) {
    records.push_back(std::move(record));
    return Status();
  }));
  return records;
}

std::string written(const std::vector<CoefficientRecord>& records) {
  std::string text;
  const auto append = [&text](std::string_view piece) {
    text += piece;
    return Status();
  };
  auto table = stream_table(TableFormat::csv, append, VariantColumn::present);
  for (const CoefficientRecord& record : records) {
    demand(bool((*table)->append(record)), "what was read can be written");
  }
  demand(bool((*table)->commit()), "the table can be ended");
  return text;
}

void check(const std::string& text) {
  const auto records = read(text);
  if (!records) {
    demand(records.error().where.starts_with("table.csv"), "the error says where");
    return;
  }
  const auto again = read(written(*records));
  demand(again && *again == *records, "what was written reads back");
}

}  // namespace
}  // namespace shoal::test

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  shoal::test::check(std::string(reinterpret_cast<const char*>(data), size));
  return 0;
}
