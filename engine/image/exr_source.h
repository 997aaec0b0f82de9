// OpenEXR files as panoramas.
#pragma once

#include <filesystem>
#include <memory>

#include "core/result.h"
#include "image/chunk_codecs.h"
#include "image/panorama_source.h"

namespace shoal {

// Opens an OpenEXR file: scanlines or tiles (level 0), every compression that the library reads,
// one of its parts, half, float or uint samples as they are. The picture is the display window,
// black where the data window does not reach; that of an environment map is its data window,
// whose border pixels lie on the poles and the seam, or on the edges of its cube's faces, +X -X +Y
// -Y +Z -Z from the top down (ImfEnvmap.h of OpenEXR).
// Errors: not_found, unreadable, malformed, unsupported (deep, no colour, sizes), usage
// (no such layer or part).
Result<std::unique_ptr<PanoramaSource>> open_exr(const std::filesystem::path& path,
                                                 const ReadOptions& options,
                                                 const ChunkCodecs& codecs);

}  // namespace shoal
