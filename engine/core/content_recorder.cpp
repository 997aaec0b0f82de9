#include "core/content_recorder.h"

namespace shoal {

void ContentRecorder::saw(std::uint64_t offset, std::span<const std::byte> bytes) {
  // Where two workers share a file, neither waits for the other.
  const std::unique_lock lock(mutex_, std::try_to_lock);
  if (!lock || offset > taken_ || offset + bytes.size() <= taken_) return;
  hasher_.update(bytes.subspan(static_cast<std::size_t>(taken_ - offset)));
  taken_ = offset + bytes.size();
}

Result<std::string> ContentRecorder::digest(const std::filesystem::path& path) {
  const std::scoped_lock lock(mutex_);
  SHOAL_RETURN_IF_ERROR(hash_rest_of_file(path, taken_, hasher_));
  return hasher_.digest();
}

}  // namespace shoal
