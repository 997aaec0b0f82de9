// Files that appear whole or not at all: written under a temporary name, synced, then renamed.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>

#include "core/result.h"

namespace shoal {

// The part of a temporary file's name that tells it is one; leftovers of a killed run are found by
// it.
inline constexpr std::string_view kTemporaryMark = ".shoal-tmp-";

class AtomicFile {
 public:
  AtomicFile(AtomicFile&& other) noexcept;
  AtomicFile& operator=(AtomicFile&& other) noexcept;
  ~AtomicFile();  // removes the temporary file unless commit() succeeded

  // Opens a temporary file beside `path`, whose folders are made when missing.
  static Result<AtomicFile> create(const std::filesystem::path& path);

  // Appends.
  Status write(std::span<const std::byte> bytes);
  Status write(std::string_view text);

  // Overwrites at an offset already written; for formats whose tables come before their data.
  Status write_at(std::uint64_t offset, std::span<const std::byte> bytes);

  // Syncs and renames to the final name. Nothing may be written afterwards.
  Status commit();

  // Where the bytes are until commit(), for libraries that insist on a name.
  [[nodiscard]] const std::filesystem::path& temporary_path() const { return temporary_; }

 private:
  AtomicFile() = default;
  Error failure(std::string_view doing) const;

  int descriptor_ = -1;
  std::filesystem::path path_;
  std::filesystem::path temporary_;
};

// The whole of a small file in one call.
Status write_file_atomically(const std::filesystem::path& path, std::string_view content);

}  // namespace shoal
