#include "output/hashed_file.h"

#include <utility>

#include "output/table_formats.h"

namespace shoal {

Result<HashedFile> HashedFile::create(const std::filesystem::path& path) {
  SHOAL_ASSIGN_OR_RETURN(file, AtomicFile::create(path));
  return HashedFile(path, std::move(file));
}

Status HashedFile::write(std::string_view text) {
  buffer_ += text;
  return buffer_.size() < kTableBufferSize ? Status() : drain();
}

Result<WrittenFile> HashedFile::commit() {
  SHOAL_RETURN_IF_ERROR(drain());
  SHOAL_RETURN_IF_ERROR(file_.commit());
  return WrittenFile{path_, hasher_.digest(), size_};
}

Status HashedFile::drain() {
  hasher_.update(buffer_);
  size_ += buffer_.size();
  Status status = file_.write(buffer_);
  buffer_.clear();
  return status;
}

}  // namespace shoal
