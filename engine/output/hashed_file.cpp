#include "output/hashed_file.h"

#include <utility>

namespace shoal {

Result<HashedFile> HashedFile::create(const std::filesystem::path& path) {
  SHOAL_ASSIGN_OR_RETURN(file, AtomicFile::create(path));
  return HashedFile(path, std::move(file));
}

Status HashedFile::write(std::string_view text) {
  hasher_.update(text);
  size_ += text.size();
  return file_.write(text);
}

Result<WrittenFile> HashedFile::commit() {
  SHOAL_RETURN_IF_ERROR(file_.commit());
  return WrittenFile{path_, hasher_.digest(), size_};
}

}  // namespace shoal
