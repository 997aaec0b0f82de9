// `shoal report`: a library as a page that opens from disk and asks nothing of any network.
//
// The folder gets index.html, which holds its style, its scripts and the table, and beside it, read
// when they are first looked at, panoramas/NNNNNN.js (pixels and coefficients) and
// thumbnails/NNNNNN.png. A library of one panorama is index.html alone. The same library gives the
// same bytes. Files appear whole; the page itself comes last.
#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <optional>
#include <span>

#include "core/result.h"
#include "library/library.h"
#include "library/pixels.h"
#include "sphere/frame.h"

namespace shoal::viz {

struct ReportSettings {
  std::filesystem::path folder;  // made where it is missing
  int thumbnail_width = 512;     // of the pictures that are looked at, >= 2
  std::optional<Frame> frame;    // of coefficients, directions and axes; that of each panorama's
                                 // table where it is not given
};

using ReportProgress = std::function<void(std::size_t done, std::size_t count)>;

// Where pictures come from.
struct PictureSource {
  // Told before `get` is asked for these panoramas at this width; what it told before is not asked
  // for any more.
  std::function<void(std::span<const std::size_t> panoramas, int width)> prepare;
  std::function<const Pixels&(std::size_t panorama, int width)> get;  // empty where there is none
  std::function<std::string(std::size_t panorama)> why_empty;
};

// Progress is told after each panorama. Panoramas with coefficients that are not finite are listed
// among the failed. What an earlier report left in the folder and this one does not have is
// removed; nothing else is. Errors: usage (a thumbnail width below 2, an index.html in the folder
// that is no report), write_failed.
[[nodiscard]] Status write_report(const Library& library, const PictureSource& pictures,
                                  const ReportSettings& settings, const ReportProgress& progress);

// The same with the panoramas' own pictures.
[[nodiscard]] Status write_report(const Library& library, PixelCache& pixels,
                                  const ReportSettings& settings, const ReportProgress& progress);

}  // namespace shoal::viz
