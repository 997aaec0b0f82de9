// The writers behind create_table() and stream_table(), and what they share.
#pragma once

#include <cstddef>
#include <filesystem>
#include <memory>
#include <string>
#include <string_view>

#include "output/coefficient_table.h"

namespace shoal {

// Bytes that a writer gathers before it hands them on.
inline constexpr std::size_t kTableBufferSize = std::size_t{1} << 20;

// A record that a table can hold, or why not.
Status check_record(const CoefficientRecord& record);

// How a table becomes text. The strings are appended to.
class TextFormat {
 public:
  virtual ~TextFormat() = default;
  virtual void begin(std::string& out) = 0;
  virtual void record(std::string& out, const CoefficientRecord& record) = 0;
  virtual void end(std::string& out) = 0;
};

[[nodiscard]] std::unique_ptr<TextFormat> make_csv_format(VariantColumn variant);
[[nodiscard]] std::unique_ptr<TextFormat> make_json_format(VariantColumn variant);

Result<std::unique_ptr<TableWriter>> create_npy_table(const std::filesystem::path& path);

}  // namespace shoal
