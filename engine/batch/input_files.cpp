#include "batch/input_files.h"

#include "batch/plan.h"
#include "core/content_hash.h"
#include "transform/layout_source.h"

namespace shoal {

Result<InputState> entry_state(const PanoramaEntry& entry) {
  InputState sum;
  for (const auto& file : picture_files(entry.file, entry.settings->projection.layout)) {
    SHOAL_ASSIGN_OR_RETURN(state, input_state(file));
    sum.size += state.size;
    // As unsigned numbers, whose sum may leave their range.
    sum.mtime_ns = static_cast<std::int64_t>(static_cast<std::uint64_t>(sum.mtime_ns) +
                                             static_cast<std::uint64_t>(state.mtime_ns));
  }
  return sum;
}

bool is_one_file(const PanoramaEntry& entry) {
  return picture_files(entry.file, entry.settings->projection.layout).size() == 1;
}

Result<std::string> hash_panorama(const std::filesystem::path& path, Layout layout) {
  const auto files = picture_files(path, layout);
  if (files.size() == 1) return hash_file(files.front());
  std::string hashes;
  for (const auto& file : files) {
    SHOAL_ASSIGN_OR_RETURN(hash, hash_file(file));
    hashes += hash;
  }
  return hash_text(hashes);
}

}  // namespace shoal
