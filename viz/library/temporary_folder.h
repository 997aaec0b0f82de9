// A folder that goes when its owner does.
#pragma once

#include <filesystem>

#include "core/result.h"

namespace shoal::viz {

class TemporaryFolder {
 public:
  TemporaryFolder(TemporaryFolder&& other) noexcept;
  TemporaryFolder& operator=(TemporaryFolder&& other) noexcept;
  ~TemporaryFolder();  // removes it with all that is in it

  // Error: write_failed.
  [[nodiscard]] static Result<TemporaryFolder> make();

  [[nodiscard]] const std::filesystem::path& path() const { return path_; }

 private:
  explicit TemporaryFolder(std::filesystem::path path) : path_(std::move(path)) {}

  std::filesystem::path path_;
};

}  // namespace shoal::viz
