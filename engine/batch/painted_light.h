// The panoramas of entries without a file: skies, projected from pixels that are painted, and the
// pictures of skies and of lights alone.
#pragma once

#include <string>

#include "batch/manifest.h"
#include "batch/store.h"
#include "core/result.h"
#include "transform/projector.h"

namespace shoal {

// A sky with its ground as pixels, and its sun beside them in closed form where it is shown.
// Precondition: the key is sound.
[[nodiscard]] PaintedPanorama painted_sky(const std::string& name, const SkyKey& sky);

// Writes the picture that an entry asks for: all of its sky, its sun and its lights, as they are
// before anything linear is applied. Error: write_failed.
Result<OutputRecord> write_picture_file(const Manifest& manifest, const PanoramaEntry& entry);

}  // namespace shoal
