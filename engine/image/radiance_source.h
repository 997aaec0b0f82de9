// Radiance pictures (.hdr, .pic) as row bands: four byte planes R, G, B (or X, Y, Z) and exponent.
#pragma once

#include <filesystem>
#include <memory>

#include "core/result.h"
#include "image/panorama_source.h"

namespace shoal {

// All eight orientations; new RLE, old RLE and flat scanlines, mixed as they may be. Bands must be
// read in order, because only expanding a scanline tells where the next one starts.
// Errors: not_found, unreadable, malformed, unsupported.
Result<std::unique_ptr<PanoramaSource>> open_radiance(const std::filesystem::path& path,
                                                      const ReadOptions& options);

}  // namespace shoal
