// Panorama files of every kind that is measured, written row by row.
#pragma once

#include <array>
#include <filesystem>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "core/result.h"

namespace shoal::bench {

// "hdr" (Radiance, new RLE); "half-C" and "float-C" (EXR scanlines R, G, B) with the compression C:
// none, rle, zips, zip, piz, pxr24, b44, b44a, dwaa, dwab.
[[nodiscard]] std::vector<std::string> panorama_file_kinds();

class PanoramaFile {
 public:
  virtual ~PanoramaFile() = default;  // leaves nothing under the file's name unless committed

  // Errors: usage (no such kind), write_failed.
  static Result<std::unique_ptr<PanoramaFile>> create(std::string_view kind,
                                                      const std::filesystem::path& path, int width,
                                                      int height);

  // Appends rows; each plane has (row_count, width) samples. Errors: write_failed.
  virtual Status write_rows(const std::array<const float*, 3>& planes, int row_count) = 0;

  // After the last row. Errors: write_failed.
  virtual Status commit() = 0;
};

struct PanoramaFileRequest {
  std::string kind;
  std::filesystem::path path;
};

// Paints one panorama into all the files, a few rows at a time.
Status make_panorama_files(int width, int height, std::uint64_t seed,
                           const std::vector<PanoramaFileRequest>& requests);

}  // namespace shoal::bench
