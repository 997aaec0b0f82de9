// A 128-bit hash of bytes (XXH3), for telling whether content or parameters changed.
// Not cryptographic: it guards against accidents, not against an adversary.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <string_view>

#include "core/result.h"

namespace shoal {

class ContentHasher {
 public:
  ContentHasher();
  ~ContentHasher();
  ContentHasher(ContentHasher&&) noexcept;
  ContentHasher& operator=(ContentHasher&&) noexcept;

  void update(std::span<const std::byte> bytes);
  void update(std::string_view text);

  // 32 lower-case hexadecimal digits of all that came so far.
  [[nodiscard]] std::string digest() const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

[[nodiscard]] std::string hash_text(std::string_view text);

// The hash of the bytes that the file has when it is opened. Errors: InputFile's.
Result<std::string> hash_file(const std::filesystem::path& path);

// Goes on with a file whose first `offset` bytes are in `hasher` already.
Status hash_rest_of_file(const std::filesystem::path& path, std::uint64_t offset,
                         ContentHasher& hasher);

}  // namespace shoal
