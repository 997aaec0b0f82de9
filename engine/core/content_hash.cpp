#include "core/content_hash.h"

#include <xxhash.h>

#include <array>
#include <vector>

#include "core/input_file.h"

namespace shoal {

struct ContentHasher::State {
  XXH3_state_t* xxh = XXH3_createState();
  State() { XXH3_128bits_reset(xxh); }
  ~State() { XXH3_freeState(xxh); }
  State(const State&) = delete;
  State& operator=(const State&) = delete;
};

ContentHasher::ContentHasher() : state_(std::make_unique<State>()) {}
ContentHasher::~ContentHasher() = default;
ContentHasher::ContentHasher(ContentHasher&&) noexcept = default;
ContentHasher& ContentHasher::operator=(ContentHasher&&) noexcept = default;

void ContentHasher::update(std::span<const std::byte> bytes) {
  XXH3_128bits_update(state_->xxh, bytes.data(), bytes.size());
}

void ContentHasher::update(std::string_view text) {
  update(std::as_bytes(std::span(text.data(), text.size())));
}

std::string ContentHasher::digest() const {
  XXH128_canonical_t canonical;
  XXH128_canonicalFromHash(&canonical, XXH3_128bits_digest(state_->xxh));
  constexpr std::string_view kDigits = "0123456789abcdef";
  std::string text;
  for (const unsigned char byte : canonical.digest) {
    text += kDigits[byte >> 4];
    text += kDigits[byte & 15];
  }
  return text;
}

std::string hash_text(std::string_view text) {
  ContentHasher hasher;
  hasher.update(text);
  return hasher.digest();
}

Result<std::string> hash_file(const std::filesystem::path& path) {
  SHOAL_ASSIGN_OR_RETURN(file, InputFile::open(path));
  ContentHasher hasher;
  std::vector<std::byte> block(std::size_t{1} << 18);
  for (std::uint64_t offset = 0;;) {
    SHOAL_ASSIGN_OR_RETURN(got, file.read_some(offset, block));
    hasher.update(std::span(block).first(got));
    offset += got;
    if (got < block.size()) return hasher.digest();
  }
}

}  // namespace shoal
