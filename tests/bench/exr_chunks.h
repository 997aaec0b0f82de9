// The compressed chunks of a scanline EXR file, read ahead, so that inflating them can be timed
// alone.
#pragma once

#include <cstddef>
#include <filesystem>
#include <span>
#include <vector>

#include "core/result.h"

namespace shoal::bench {

struct ExrChunks {
  struct Chunk {
    std::size_t offset = 0;  // in `bytes`
    std::size_t packed_size = 0;
    std::size_t unpacked_size = 0;  // equal to packed_size: stored as it is
  };
  std::vector<std::byte> bytes;
  std::vector<Chunk> chunks;
  std::size_t largest_unpacked = 0;
  std::size_t unpacked_total = 0;

  [[nodiscard]] std::span<const std::byte> packed(const Chunk& chunk) const {
    return std::span(bytes).subspan(chunk.offset, chunk.packed_size);
  }
};

// All chunks of the first part. Errors: unreadable, unsupported (tiles, deep).
Result<ExrChunks> read_exr_chunks(const std::filesystem::path& path);

}  // namespace shoal::bench
