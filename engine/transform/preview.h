// Smaller pictures of panoramas: each texel is the mean over its solid angle of what it covers.
//
// Of an equirect panorama the light of the whole sphere is kept: the sum of radiance times solid
// angle over all texels is that of the panorama, but for rounding. Any ratio of sizes; texels that
// lie across an edge of the smaller grid count in both of its texels by their parts. Accuracy: a
// relative error below 2.2e-6 of the mean of magnitudes.
// Of other layouts the preview is equirect as well, resampled (transform/layout_preview.h).
#pragma once

#include <array>
#include <atomic>
#include <filesystem>
#include <string>
#include <vector>

#include "core/result.h"
#include "image/map_writer.h"
#include "image/panorama_source.h"
#include "sphere/layout.h"

namespace shoal {

struct PreviewSettings {
  int width = 256;                   // at least 1
  Layout layout = Layout::equirect;  // of pictures that do not say themselves what they are
};

// Equirect, in the native frame.
struct Preview {
  int width = 0;
  int height = 0;
  // Red, green, blue, each (height, width), linear Rec.709; the picture as it is looked at,
  // whichever way the file stores it.
  std::array<std::vector<float>, 3> planes;
  Layout layout = Layout::equirect;   // that the panorama was taken for
  std::vector<std::string> warnings;  // the file's, and what was taken approximately; sentences
};

// A preview of `width` times (width + 1) / 2 texels, or of as many columns and rows as the panorama
// has where these are fewer. Texels with a channel that is not finite are left out; where nothing
// else is covered, the preview is black. Reads the bands once, in one thread, and holds one of them
// and a few scanlines besides the preview, of other layouts also a picture of the preview's size.
// `stop` ends it early.
// Errors: those of open_picture() (transform/layout_source.h) and of its bands; usage (a size that
// the layout does not have); interrupted.
Result<Preview> make_preview(const std::filesystem::path& path, const ReadOptions& options,
                             const PreviewSettings& settings, const std::atomic<bool>& stop);

// Error: write_failed.
Status write_preview(const Preview& preview, MapFormat format, const std::filesystem::path& path);

}  // namespace shoal
