#include "batch/leftovers.h"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <string>
#include <string_view>
#include <utility>

#include "core/atomic_file.h"

namespace shoal {
namespace {

constexpr std::string_view kMarkProperty = "running";

// Nothing in here may end a run: what cannot be read or removed stays.
template <typename Iterator>
int remove_temporaries(const std::filesystem::path& folder) {
  int count = 0;
  std::error_code code;
  for (Iterator entry(folder, code), end; !code && entry != end; entry.increment(code)) {
    const std::string name = entry->path().filename().string();
    std::error_code ignored;
    if (name.find(kTemporaryMark) == name.npos || !entry->is_regular_file(ignored)) continue;
    count += std::filesystem::remove(entry->path(), ignored) ? 1 : 0;
  }
  return count;
}

}  // namespace

int remove_leftovers(const std::filesystem::path& folder) {
  return remove_temporaries<std::filesystem::directory_iterator>(folder) +
         remove_temporaries<std::filesystem::recursive_directory_iterator>(folder / "maps") +
         remove_temporaries<std::filesystem::recursive_directory_iterator>(folder / "exports");
}

RunMark::RunMark(RunMark&& other) noexcept : descriptor_(std::exchange(other.descriptor_, -1)) {}

RunMark& RunMark::operator=(RunMark&& other) noexcept {
  std::swap(descriptor_, other.descriptor_);
  return *this;
}

RunMark::~RunMark() {
  if (descriptor_ >= 0) ::close(descriptor_);
}

Result<RunMark> RunMark::set(const std::filesystem::path& folder, Store& store) {
  RunMark mark;
  mark.descriptor_ = ::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  const bool alone = mark.descriptor_ >= 0 && ::flock(mark.descriptor_, LOCK_EX | LOCK_NB) == 0;
  SHOAL_ASSIGN_OR_RETURN(before, store.property(kMarkProperty));
  if (alone && !before.empty()) remove_leftovers(folder);
  if (mark.descriptor_ >= 0) ::flock(mark.descriptor_, LOCK_SH | LOCK_NB);
  SHOAL_RETURN_IF_ERROR(store.set_property(kMarkProperty, "yes"));
  SHOAL_RETURN_IF_ERROR(store.flush());
  return mark;
}

Status RunMark::clear(Store& store) {
  SHOAL_RETURN_IF_ERROR(store.set_property(kMarkProperty, ""));
  return store.flush();
}

}  // namespace shoal
