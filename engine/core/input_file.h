// A read-only file with positioned reads: no shared file offset, so threads may share one.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <span>
#include <string>

#include "core/result.h"

namespace shoal {

class ContentRecorder;

class InputFile {
 public:
  InputFile() = default;
  InputFile(InputFile&& other) noexcept;
  InputFile& operator=(InputFile&& other) noexcept;
  ~InputFile();

  // Errors: not_found; unreadable (permission, a directory, a device, or whatever errno says).
  // `recorder`, where there is one, is handed all that is read.
  static Result<InputFile> open(const std::filesystem::path& path,
                                std::shared_ptr<ContentRecorder> recorder = nullptr);

  [[nodiscard]] std::uint64_t size() const { return size_; }
  [[nodiscard]] const std::string& path() const { return path_; }

  // Fills `bytes` from `offset`. A file that ends before is an error (malformed).
  Status read_exactly(std::uint64_t offset, std::span<std::byte> bytes) const;

  // Reads up to bytes.size() bytes; returns how many there were, less only at the end of the file.
  Result<std::size_t> read_some(std::uint64_t offset, std::span<std::byte> bytes) const;

 private:
  int descriptor_ = -1;
  std::uint64_t size_ = 0;
  std::string path_;
  std::shared_ptr<ContentRecorder> recorder_;
};

// Asks the system to read the first `limit` bytes of a file, so that they are in memory when it is
// opened in earnest. Returns before they are. Whatever is wrong with the file, its reader will
// tell.
void prefetch_file(const std::filesystem::path& path, std::uint64_t limit);

}  // namespace shoal
