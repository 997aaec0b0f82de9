#include "core/content_hash.h"

#include <gtest/gtest.h>
#include <xxhash.h>

#include <fstream>
#include <random>
#include <vector>

#include "support/temporary_folder.h"

namespace shoal {
namespace {

std::vector<std::byte> noise(std::size_t size) {
  std::mt19937 random(static_cast<unsigned>(size));
  std::vector<std::byte> bytes(size);
  for (std::byte& byte : bytes) byte = static_cast<std::byte>(random());
  return bytes;
}

// xxHash's own function for bytes that are all there, which goes other ways than the one for
// pieces.
std::string whole_hash(const std::vector<std::byte>& bytes) {
  XXH128_canonical_t canonical;
  XXH128_canonicalFromHash(&canonical, XXH3_128bits(bytes.data(), bytes.size()));
  std::string text;
  for (const unsigned char byte : canonical.digest) {
    text += "0123456789abcdef"[byte >> 4];
    text += "0123456789abcdef"[byte & 15];
  }
  return text;
}

// The value that xxHash documents for no bytes at all with seed 0.
TEST(ContentHash, NothingHasTheKnownHash) {
  EXPECT_EQ(hash_text(""), "99aa06d3014798d86001c324468d497f");
}

// Sizes about the borders where XXH3 changes its way: 16, 128, 240 bytes, its buffer of 256, its
// block of 1024. Whatever instructions are used, stores written elsewhere must stay true.
TEST(ContentHash, PiecesHashAsTheWholeDoes) {
  for (const std::size_t size :
       {1, 15, 17, 127, 129, 239, 241, 255, 257, 1023, 1025, 4096, 300001}) {
    const std::vector<std::byte> bytes = noise(size);
    for (const std::size_t piece : {std::size_t{1}, std::size_t{63}, std::size_t{1000}, size}) {
      if (size / piece > 10000) continue;
      ContentHasher hasher;
      for (std::size_t at = 0; at < size; at += piece) {
        hasher.update(std::span(bytes).subspan(at, std::min(piece, size - at)));
      }
      EXPECT_EQ(hasher.digest(), whole_hash(bytes)) << size << " bytes in pieces of " << piece;
    }
  }
}

TEST(ContentHash, OfAFileIsThatOfItsBytes) {
  const test::TemporaryFolder folder;
  const auto path = folder / "file";
  for (const std::size_t size : {0, 1, (1 << 17) - 1, 1 << 17, (1 << 17) + 1, 1 << 20}) {
    const std::vector<std::byte> bytes = noise(size);
    std::ofstream(path, std::ios::binary)
        .write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(size));
    const auto hash = hash_file(path);
    ASSERT_TRUE(hash) << hash.error().text();
    EXPECT_EQ(*hash, whole_hash(bytes)) << size;
  }
  EXPECT_EQ(hash_file(folder / "none").error().code, ErrorCode::not_found);
}

}  // namespace
}  // namespace shoal
