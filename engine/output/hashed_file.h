// An atomic file that knows the hash and size of what went into it, for the store. It gathers what
// is written, a mebibyte at a time.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <utility>

#include "core/atomic_file.h"
#include "core/content_hash.h"
#include "output/coefficient_table.h"

namespace shoal {

class HashedFile {
 public:
  static Result<HashedFile> create(const std::filesystem::path& path);

  Status write(std::string_view text);
  Result<WrittenFile> commit();

 private:
  HashedFile(std::filesystem::path path, AtomicFile file)
      : path_(std::move(path)), file_(std::move(file)) {}
  Status drain();

  std::filesystem::path path_;
  AtomicFile file_;
  ContentHasher hasher_;
  std::string buffer_;
  std::uint64_t size_ = 0;
};

}  // namespace shoal
