#include "image/exr_chunk_table.h"

#include <algorithm>
#include <cstddef>
#include <span>

namespace shoal {
namespace {

// What the library finds by walking over the chunks; 0 if it is not there.
std::uint64_t search_chunk(const ExrContext& context, const ExrPart& part, int chunk) {
  exr_chunk_info_t info{};
  const int line = part.data.y_begin + chunk * part.chunk_rows;
  const Status found = context.run(context.file().path(), [&] {
    return exr_read_scanline_chunk_info(context.handle(), part.index, line, &info);
  });
  return found ? info.data_offset - ExrChunkTable::leader_size(context) : 0;
}

}  // namespace

Result<ExrChunkTable> ExrChunkTable::read(const ExrContext& context, const ExrPart& part) {
  const auto count =
      static_cast<std::size_t>((part.data.height() + part.chunk_rows - 1) / part.chunk_rows);
  std::vector<std::uint64_t> offsets(count);
  SHOAL_RETURN_IF_ERROR(context.file().read_exactly(context.table(part.index).offset,
                                                    std::as_writable_bytes(std::span(offsets))));

  const std::size_t leader = leader_size(context);
  const std::uint64_t file_end = context.file().size();
  const auto is_plausible = [&](std::uint64_t offset) {
    return offset >= context.first_chunk_offset() && offset < file_end &&
           file_end - offset >= leader;
  };
  for (std::size_t chunk = 0; chunk < count; ++chunk) {
    if (is_plausible(offsets[chunk])) continue;
    offsets[chunk] = search_chunk(context, part, static_cast<int>(chunk));
  }

  // A chunk ends before the next one of its part begins, and is never longer than its pixels.
  std::vector<std::uint64_t> sorted = offsets;
  std::sort(sorted.begin(), sorted.end());
  const std::uint64_t longest = leader + part.pixel_bytes() *
                                             static_cast<std::uint64_t>(part.data.width()) *
                                             static_cast<std::uint64_t>(part.chunk_rows);
  ExrChunkTable table;
  table.extents_.reserve(count);
  for (const std::uint64_t offset : offsets) {
    if (!is_plausible(offset)) {
      table.extents_.push_back({});
      continue;
    }
    const auto next = std::upper_bound(sorted.begin(), sorted.end(), offset);
    const std::uint64_t end = next == sorted.end() ? file_end : *next;
    table.extents_.push_back({offset, std::min(end, offset + longest)});
  }
  return table;
}

}  // namespace shoal
