// Expands the chunks of EXR's RLE, ZIPS, ZIP, PIZ and PXR24 compression, and of none.
#pragma once

#include <openexr.h>

#include <cstddef>
#include <memory>
#include <span>
#include <vector>

#include "core/aligned_buffer.h"
#include "image/chunk_codecs.h"
#include "image/exr_expansion.h"
#include "image/exr_piz.h"
#include "image/zlib_inflater.h"

namespace shoal {

class ExrInflater {
 public:
  struct Chunk {
    std::span<const std::byte> packed;
    ExrChunkShape shape;
    std::span<std::byte> out;  // as large as `shape` says
  };

  static bool can_expand(exr_compression_t compression);

  // Precondition: can_expand(compression).
  ExrInflater(exr_compression_t compression, const ChunkCodecs& codecs);

  // Expands all chunks, each to exactly fill its `out`, and returns the number of the first damaged
  // one, or chunks.size(). The more chunks come together, up to ZlibInflater::kLanes, the faster
  // are those of ZIP, ZIPS and PXR24. Chunks that would not become smaller are stored as they are,
  // so where the sizes are equal `packed` is copied, whatever the compression. The scratch memory
  // grows to ZlibInflater::kLanes times the largest chunk met.
  std::size_t expand(std::span<const Chunk> chunks);

 private:
  Expansion expand_one(const Chunk& chunk);
  Expansion expand_runs(const Chunk& chunk);
  std::size_t inflate(std::span<const Chunk> chunks);

  exr_compression_t compression_;
  ChunkCodecs codecs_;
  ZlibInflater inflater_;
  std::vector<ZlibInflater::Job> jobs_;
  std::vector<std::size_t> chunk_of_job_;
  AlignedBuffer<std::byte> shuffled_;
  std::unique_ptr<PizExpander> piz_;
};

// EXR's run lengths: a count n < 0 is followed by -n bytes as they are, n >= 0 by one byte that is
// repeated n + 1 times. Damaged unless `packed` fills `out` to its last byte.
Expansion expand_exr_runs(std::span<const std::byte> packed, std::span<std::byte> out);

}  // namespace shoal
