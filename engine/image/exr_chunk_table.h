// Where the chunks of a scanline part lie in the file.
#pragma once

#include <cstdint>
#include <vector>

#include "core/result.h"
#include "image/exr_context.h"
#include "image/exr_part.h"

namespace shoal {

class ExrChunkTable {
 public:
  // Bytes [begin, end) of the file that hold a chunk, its leader (part number in files of several
  // parts, line number, size) included, and perhaps something behind it: a chunk's length is known
  // only from its leader. Empty: the chunk is missing.
  struct Extent {
    std::uint64_t begin = 0;
    std::uint64_t end = 0;
    [[nodiscard]] std::uint64_t size() const { return end - begin; }
  };

  ExrChunkTable() = default;

  // Reads the table in one go. Entries that cannot be right (a writer that was killed leaves zeros)
  // are searched for in the file. Errors: unreadable, malformed.
  static Result<ExrChunkTable> read(const ExrContext& context, const ExrPart& part);

  [[nodiscard]] const Extent& operator[](int chunk) const { return extents_[chunk]; }

  // Bytes before a chunk's data: its part, where there are several, its first line, its size.
  static std::size_t leader_size(const ExrContext& context) {
    return context.is_multi_part() ? 12 : 8;
  }

 private:
  std::vector<Extent> extents_;
};

}  // namespace shoal
