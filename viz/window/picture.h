// Pictures as bytes, and PNG files of them.
#pragma once

#include <filesystem>
#include <vector>

#include "core/result.h"

namespace shoal::viz {

struct PictureSize {
  int width = 1280;
  int height = 720;

  friend bool operator==(const PictureSize&, const PictureSize&) = default;
};

// 8-bit sRGB, (height, width, 3), the top row first.
struct Picture {
  PictureSize size;
  std::vector<unsigned char> rgb;

  friend bool operator==(const Picture&, const Picture&) = default;
};

// PNG without a time stamp; appears whole or not at all. Error: write_failed.
[[nodiscard]] Status write_png(const Picture& picture, const std::filesystem::path& path);

// A PNG as 8-bit sRGB; what is transparent stands on black. Errors: not_found, malformed.
[[nodiscard]] Result<Picture> read_png(const std::filesystem::path& path);

}  // namespace shoal::viz
