#include "library/temporary_folder.h"

#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <string>
#include <system_error>
#include <utility>

namespace shoal::viz {

TemporaryFolder::TemporaryFolder(TemporaryFolder&& other) noexcept
    : path_(std::exchange(other.path_, {})) {}

TemporaryFolder& TemporaryFolder::operator=(TemporaryFolder&& other) noexcept {
  std::swap(path_, other.path_);
  return *this;
}

TemporaryFolder::~TemporaryFolder() {
  std::error_code ignored;
  if (!path_.empty()) std::filesystem::remove_all(path_, ignored);
}

Result<TemporaryFolder> TemporaryFolder::make() {
  std::error_code code;
  const auto parent = std::filesystem::temp_directory_path(code);
  std::string name =
      ((code ? std::filesystem::path("/tmp") : parent) / "shoal-viz-XXXXXX").string();
  if (::mkdtemp(name.data())) return TemporaryFolder(name);
  return Error{ErrorCode::write_failed,
               std::string("a temporary folder cannot be made: ") + std::strerror(errno), name,
               "TMPDIR names another place"};
}

}  // namespace shoal::viz
