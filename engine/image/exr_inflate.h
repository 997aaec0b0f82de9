// Expands the chunks of EXR's ZIP, ZIPS and RLE compression, and of none.
#pragma once

#include <libdeflate.h>
#include <openexr.h>

#include <cstddef>
#include <memory>
#include <span>

#include "core/aligned_buffer.h"
#include "image/chunk_codecs.h"

namespace shoal {

enum class Expansion { done, damaged };

class ExrInflater {
 public:
  static bool can_expand(exr_compression_t compression);

  ExrInflater(exr_compression_t compression, const ChunkCodecs& codecs);

  // Expands `packed` to exactly fill `out`. Chunks that would not become smaller are stored as they
  // are and need no expansion: without compression, whatever comes here is damaged.
  // The scratch memory grows to the largest chunk met.
  Expansion expand(std::span<const std::byte> packed, std::span<std::byte> out);

 private:
  struct Free {
    void operator()(libdeflate_decompressor* inflater) const {
      libdeflate_free_decompressor(inflater);
    }
  };
  exr_compression_t compression_;
  ChunkCodecs codecs_;
  std::unique_ptr<libdeflate_decompressor, Free> inflater_;
  AlignedBuffer<std::byte> shuffled_;
};

// EXR's run lengths: a count n < 0 is followed by -n bytes as they are, n >= 0 by one byte that is
// repeated n + 1 times. Damaged unless `packed` fills `out` to its last byte.
Expansion expand_exr_runs(std::span<const std::byte> packed, std::span<std::byte> out);

}  // namespace shoal
