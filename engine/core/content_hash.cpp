#include "core/content_hash.h"

#include <algorithm>
#include <memory>

#include "core/hash_update.h"
#include "core/input_file.h"
#include "core/processor.h"

namespace shoal {
namespace {

// Stays in a core's second cache between the reading and the hashing.
constexpr std::uint64_t kBlockBytes = std::uint64_t{1} << 17;

using HashUpdate = void (*)(XXH3_state_t* state, const void* bytes, std::size_t size);

void hash_update_baseline(XXH3_state_t* state, const void* bytes, std::size_t size) {
  XXH3_128bits_update(state, bytes, size);
}

HashUpdate choose_update() {
#ifdef SHOAL_HASH_AVX2
  if (SHOAL_PROCESSOR_HAS("avx2", AVX2)) return hash_update_avx2;
#endif
  return hash_update_baseline;
}

}  // namespace

struct ContentHasher::State {
  XXH3_state_t xxh;  // at a cache line, as its type demands
  State() { XXH3_128bits_reset(&xxh); }
};

ContentHasher::ContentHasher() : state_(std::make_unique<State>()) {}
ContentHasher::~ContentHasher() = default;
ContentHasher::ContentHasher(ContentHasher&&) noexcept = default;
ContentHasher& ContentHasher::operator=(ContentHasher&&) noexcept = default;

void ContentHasher::update(std::span<const std::byte> bytes) {
  static const HashUpdate kUpdate = choose_update();
  kUpdate(&state_->xxh, bytes.data(), bytes.size());
}

void ContentHasher::update(std::string_view text) {
  update(std::as_bytes(std::span(text.data(), text.size())));
}

std::string ContentHasher::digest() const {
  XXH128_canonical_t canonical;
  XXH128_canonicalFromHash(&canonical, XXH3_128bits_digest(&state_->xxh));
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

Status hash_rest_of_file(const std::filesystem::path& path, std::uint64_t offset,
                         ContentHasher& hasher) {
  SHOAL_ASSIGN_OR_RETURN(file, InputFile::open(path));
  if (offset >= file.size()) return {};
  const auto size = static_cast<std::size_t>(std::min(kBlockBytes, file.size() - offset));
  const auto block = std::make_unique_for_overwrite<std::byte[]>(size);
  while (offset < file.size()) {
    SHOAL_ASSIGN_OR_RETURN(got, file.read_some(offset, std::span(block.get(), size)));
    hasher.update(std::span(block.get(), got));
    offset += got;
    if (got < size) break;
  }
  return {};
}

Result<std::string> hash_file(const std::filesystem::path& path) {
  ContentHasher hasher;
  SHOAL_RETURN_IF_ERROR(hash_rest_of_file(path, 0, hasher));
  return hasher.digest();
}

}  // namespace shoal
