// Smaller pictures of panoramas: each texel is the mean over its solid angle of what it covers.
//
// The light of the whole sphere is kept: the sum of radiance times solid angle over all texels is
// that of the panorama, but for rounding. Any ratio of sizes; texels that lie across an edge of the
// smaller grid count in both of its texels by their parts.
// Accuracy: 32 scanlines at the most are summed in single precision, the rest is double: the
// relative error is below 2.2e-6 of the mean of magnitudes.
#pragma once

#include <array>
#include <atomic>
#include <filesystem>
#include <string>
#include <vector>

#include "core/result.h"
#include "image/map_writer.h"
#include "image/panorama_source.h"

namespace shoal {

struct Preview {
  int width = 0;
  int height = 0;
  // Red, green, blue, each (height, width), linear Rec.709; the picture as it is looked at,
  // whichever way the file stores it.
  std::array<std::vector<float>, 3> planes;
  std::vector<std::string> warnings;  // the file's, and what was taken approximately; sentences
};

// A preview of `width` times (width + 1) / 2 texels, or of as many columns and rows as the panorama
// has where these are fewer. Texels with a channel that is not finite are left out; where nothing
// else is covered, the preview is black. Reads the bands once, in one thread, and holds one of them
// and a few scanlines besides the preview. `stop` ends it early.
// Errors: those of open_panorama() and of its bands; unsupported (EXR's envmap CUBE);
// interrupted. Precondition: width >= 1.
Result<Preview> make_preview(const std::filesystem::path& path, const ReadOptions& options,
                             int width, const std::atomic<bool>& stop);

// Error: write_failed.
Status write_preview(const Preview& preview, MapFormat format, const std::filesystem::path& path);

}  // namespace shoal
