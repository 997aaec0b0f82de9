#include "bench/exr_chunks.h"

#include <openexr.h>

#include <algorithm>
#include <memory>
#include <type_traits>

namespace shoal::bench {
namespace {

struct CloseContext {
  void operator()(exr_context_t context) const { exr_finish(&context); }
};
using Context = std::unique_ptr<std::remove_pointer_t<exr_context_t>, CloseContext>;

Result<Context> open_context(const std::filesystem::path& path) {
  exr_context_t context = nullptr;
  const exr_context_initializer_t settings = EXR_DEFAULT_CONTEXT_INITIALIZER;
  if (exr_start_read(&context, path.c_str(), &settings) != EXR_ERR_SUCCESS) {
    return Error{ErrorCode::unreadable, "is no EXR file that can be opened", path.string(), ""};
  }
  return Context(context);
}

}  // namespace

Result<ExrChunks> read_exr_chunks(const std::filesystem::path& path) {
  SHOAL_ASSIGN_OR_RETURN(context, open_context(path));
  exr_storage_t storage{};
  exr_attr_box2i_t window{};
  std::int32_t chunk_rows = 0;
  if (exr_get_storage(context.get(), 0, &storage) != EXR_ERR_SUCCESS ||
      exr_get_data_window(context.get(), 0, &window) != EXR_ERR_SUCCESS ||
      storage != EXR_STORAGE_SCANLINE ||
      exr_get_scanlines_per_chunk(context.get(), 0, &chunk_rows) != EXR_ERR_SUCCESS) {
    return Error{ErrorCode::unsupported, "has no scanlines", path.string(), ""};
  }
  ExrChunks chunks;
  for (int y = window.min.y; y <= window.max.y; y += chunk_rows) {
    exr_chunk_info_t info{};
    exr_result_t read = exr_read_scanline_chunk_info(context.get(), 0, y, &info);
    const std::size_t offset = chunks.bytes.size();
    if (read == EXR_ERR_SUCCESS) {
      chunks.bytes.resize(offset + info.packed_size);
      read = exr_read_chunk(context.get(), 0, &info, chunks.bytes.data() + offset);
    }
    if (read != EXR_ERR_SUCCESS) {
      return Error{ErrorCode::unreadable, "has a chunk that cannot be read", path.string(), ""};
    }
    chunks.chunks.push_back({offset, info.packed_size, info.unpacked_size});
    chunks.largest_unpacked = std::max<std::size_t>(chunks.largest_unpacked, info.unpacked_size);
    chunks.unpacked_total += info.unpacked_size;
  }
  return chunks;
}

}  // namespace shoal::bench
