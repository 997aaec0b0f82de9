#include "core/atomic_file.h"

#include <fcntl.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <cstring>
#include <utility>

namespace shoal {
namespace {

std::string_view hint_for(int reason) {
  switch (reason) {
    case ENOSPC:
    case EDQUOT:
      return "free some space and run again; finished work is kept";
    case EACCES:
    case EPERM:
    case EROFS:
      return "check the permissions of the output folder, or name another one";
    case ENOENT:  // although it is there, or was just made: /proc and the like
      return "its folder takes no new files; name another one";
    case ENOTDIR:
      return "a part of the path is a file; name another folder";
    case EISDIR:
      return "there is a folder of that name; name another file";
    case ENAMETOOLONG:
      return "name a shorter path";
    default:
      return "";
  }
}

Error write_error(const std::filesystem::path& path, std::string_view doing, int reason) {
  return Error{ErrorCode::write_failed,
               "cannot be " + std::string(doing) + ": " + std::strerror(reason), path.string(),
               std::string(hint_for(reason))};
}

// Makes the rename itself durable. Some file systems refuse to sync a folder; then there is
// nothing more to be done, and the file is whole either way.
void sync_folder(const std::filesystem::path& folder) {
  const int descriptor = ::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (descriptor < 0) return;
  ::fsync(descriptor);
  ::close(descriptor);
}

}  // namespace

AtomicFile::AtomicFile(AtomicFile&& other) noexcept
    : descriptor_(std::exchange(other.descriptor_, -1)),
      path_(std::move(other.path_)),
      temporary_(std::exchange(other.temporary_, {})) {}

AtomicFile& AtomicFile::operator=(AtomicFile&& other) noexcept {
  std::swap(descriptor_, other.descriptor_);
  std::swap(path_, other.path_);
  std::swap(temporary_, other.temporary_);
  return *this;
}

AtomicFile::~AtomicFile() {
  if (descriptor_ >= 0) ::close(descriptor_);
  if (!temporary_.empty()) ::unlink(temporary_.c_str());
}

Error AtomicFile::failure(std::string_view doing) const { return write_error(path_, doing, errno); }

Result<AtomicFile> AtomicFile::create(const std::filesystem::path& path) {
  static std::atomic<unsigned> counter{0};
  const auto folder = path.has_parent_path() ? path.parent_path() : std::filesystem::path(".");
  std::error_code code;
  std::filesystem::create_directories(folder, code);
  if (code) return write_error(folder, "made", code.value());

  AtomicFile file;
  file.path_ = path;
  auto temporary = folder / (path.filename().string() + std::string(kTemporaryMark) +
                             std::to_string(::getpid()) + "-" + std::to_string(counter++));
  file.descriptor_ = ::open(temporary.c_str(), O_RDWR | O_CREAT | O_TRUNC | O_CLOEXEC, 0666);
  if (file.descriptor_ < 0) return file.failure("opened for writing");
  file.temporary_ = std::move(temporary);
  return file;
}

Status AtomicFile::write(std::span<const std::byte> bytes) {
  while (!bytes.empty()) {
    const ssize_t done = ::write(descriptor_, bytes.data(), bytes.size());
    if (done < 0 && errno == EINTR) continue;
    if (done < 0) return failure("written");
    bytes = bytes.subspan(static_cast<std::size_t>(done));
  }
  return {};
}

Status AtomicFile::write(std::string_view text) {
  return write(std::as_bytes(std::span(text.data(), text.size())));
}

Status AtomicFile::write_at(std::uint64_t offset, std::span<const std::byte> bytes) {
  while (!bytes.empty()) {
    const ssize_t done =
        ::pwrite(descriptor_, bytes.data(), bytes.size(), static_cast<off_t>(offset));
    if (done < 0 && errno == EINTR) continue;
    if (done < 0) return failure("written");
    bytes = bytes.subspan(static_cast<std::size_t>(done));
    offset += static_cast<std::uint64_t>(done);
  }
  return {};
}

Status AtomicFile::commit() {
  if (::fsync(descriptor_) != 0) return failure("synced");
  if (::close(std::exchange(descriptor_, -1)) != 0) return failure("closed");
  if (::rename(temporary_.c_str(), path_.c_str()) != 0) return failure("renamed into place");
  temporary_.clear();
  sync_folder(path_.has_parent_path() ? path_.parent_path() : std::filesystem::path("."));
  return {};
}

Status write_file_atomically(const std::filesystem::path& path, std::string_view content) {
  SHOAL_ASSIGN_OR_RETURN(file, AtomicFile::create(path));
  SHOAL_RETURN_IF_ERROR(file.write(content));
  return file.commit();
}

}  // namespace shoal
