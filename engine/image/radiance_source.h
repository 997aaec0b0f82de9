// Radiance pictures (.hdr, .pic) as row bands: four byte planes R, G, B (or X, Y, Z) and exponent.
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>

#include "core/result.h"
#include "image/panorama_source.h"

namespace shoal {

// All eight orientations; new RLE, old RLE and flat scanlines, mixed as they may be. Bands may be
// read in any order and by several readers at once; in order is quickest. A band may be empty.
// Errors: not_found, unreadable, malformed, unsupported.
Result<std::unique_ptr<PanoramaSource>> open_radiance(const std::filesystem::path& path,
                                                      const ReadOptions& options);

// How the file is cut into bands (radiance_pieces.h); both at least 1.
struct RadianceCut {
  std::uint64_t piece_bytes = 1;
  int max_scanlines = 1;
};

// The same, cut as the caller wants it and not as is quickest.
Result<std::unique_ptr<PanoramaSource>> open_radiance(const std::filesystem::path& path,
                                                      const ReadOptions& options,
                                                      const RadianceCut& cut);

}  // namespace shoal
