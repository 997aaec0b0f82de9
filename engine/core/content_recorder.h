// The hash of a file's content, taken from the bytes that somebody reads anyway.
//
// A second reading of a file costs as much as the first: of a run over uncompressed half EXR it was
// half. Here whoever reads the file hands over what it got, while it is in the processor's cache.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <mutex>
#include <span>
#include <string>

#include "core/content_hash.h"
#include "core/result.h"

namespace shoal {

class ContentRecorder {
 public:
  // These bytes stand at `offset`. They are taken if they go on from what was taken before, which
  // is what happens while one worker reads a file from its beginning to its end; others are left
  // for digest(). Any number of threads.
  void saw(std::uint64_t offset, std::span<const std::byte> bytes);

  // What hash_file() gives, of the bytes seen and of those that are still missing at the end, which
  // are read now. Once, and after the last saw(). Errors: hash_file()'s.
  Result<std::string> digest(const std::filesystem::path& path);

 private:
  std::mutex mutex_;  // guards what follows
  ContentHasher hasher_;
  std::uint64_t taken_ = 0;  // bytes from the file's beginning
};

}  // namespace shoal
