// What the fuzzers share: bytes as a file, and what ends a run that is wrong.
#pragma once

#include <fcntl.h>
#include <sys/mman.h>
#include <unistd.h>

#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <span>
#include <string>

namespace shoal::test {

// A file in memory, whose path can be opened as often as one likes.
class MemoryFile {
 public:
  explicit MemoryFile(std::span<const std::uint8_t> bytes)
      : descriptor_(memfd_create("shoal-fuzz", MFD_CLOEXEC)) {
    if (descriptor_ < 0 ||
        write(descriptor_, bytes.data(), bytes.size()) != static_cast<ssize_t>(bytes.size())) {
      std::perror("shoal-fuzz: no memory for a file");
      std::exit(1);
    }
  }
  ~MemoryFile() { close(descriptor_); }
  MemoryFile(const MemoryFile&) = delete;
  MemoryFile& operator=(const MemoryFile&) = delete;

  [[nodiscard]] std::filesystem::path path() const {
    return "/proc/self/fd/" + std::to_string(descriptor_);
  }

 private:
  int descriptor_;
};

// Ends the run as a crash does, so that the fuzzer keeps the input.
inline void demand(bool is_true, const std::string& what) {
  if (is_true) return;
  std::fprintf(stderr, "not true: %s\n", what.c_str());
  std::abort();
}

}  // namespace shoal::test
