// An EXR file opened with OpenEXRCore on our own positioned reads: the parsed header, and the one
// place where the library's failures become errors. Immutable and shared by threads.
#pragma once

#include <openexr.h>

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "core/input_file.h"
#include "core/result.h"

namespace shoal {

class ExrContext {
 public:
  // Parses the header, all of it, and finds the chunk tables.
  // Errors: not_found, unreadable, malformed.
  static Result<std::shared_ptr<const ExrContext>> open(
      const std::filesystem::path& path, std::shared_ptr<ContentRecorder> recorder = nullptr);

  ~ExrContext();
  ExrContext(const ExrContext&) = delete;
  ExrContext& operator=(const ExrContext&) = delete;

  [[nodiscard]] exr_const_context_t handle() const { return handle_; }
  [[nodiscard]] const InputFile& file() const { return file_; }
  [[nodiscard]] int part_count() const { return static_cast<int>(tables_.size()); }
  [[nodiscard]] bool is_multi_part() const { return multi_part_; }

  // Where the table of chunk offsets of a part lies (8 bytes an entry), checked to be in the file.
  struct TableExtent {
    std::uint64_t offset = 0;
    std::uint64_t count = 0;
  };
  [[nodiscard]] const TableExtent& table(int part) const { return tables_[part]; }
  // The first byte after all tables: no chunk can begin before.
  [[nodiscard]] std::uint64_t first_chunk_offset() const { return first_chunk_offset_; }

  // Runs one call of the library; its failure becomes an error at `where`, in the library's words.
  template <typename Call>
  Status run(const std::string& where, Call&& call) const {
    forget_messages();
    const exr_result_t result = std::forward<Call>(call)();
    if (result == EXR_ERR_SUCCESS) return {};
    return failure(result, where);
  }

 private:
  ExrContext() = default;
  static void forget_messages();
  static Error failure(exr_result_t result, const std::string& where);
  Status find_tables();

  InputFile file_;
  exr_context_t handle_ = nullptr;
  bool multi_part_ = false;
  std::vector<TableExtent> tables_;
  std::uint64_t first_chunk_offset_ = 0;
};

}  // namespace shoal
