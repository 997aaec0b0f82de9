// A panorama's light in a variant: everything linear, applied to its projection.
#pragma once

#include <optional>
#include <vector>

#include "batch/manifest.h"
#include "core/result.h"
#include "output/light_table.h"
#include "sphere/automatic_window.h"
#include "sphere/coefficients.h"
#include "sphere/light_quality.h"
#include "transform/projector.h"

namespace shoal {

struct VariantLight {
  Coefficients radiance;                  // native frame
  std::vector<double> gains;              // of the window, a degree; all 1 where there is none
  std::optional<AutomaticWindow> fitted;  // where the window is the automatic one
};

// In this order: the file's light and the entry's lights together, white balance, matrix, scale and
// exposure, the rotation, the dominant light taken out or alone, the window. What is not asked for
// leaves the bits as they are.
// Errors: usage (linear keys that make no sense; an automatic window of light whose mean is not
// positive).
Result<VariantLight> variant_light(const Projection& projection, const PanoramaEntry& entry,
                                   const Variant& variant);

// The figures of that light. They tell errors where the projection knows the light any finer than
// the entry's degree. Errors: as variant_light().
Result<LightQuality> variant_quality(const Projection& projection, const PanoramaEntry& entry,
                                     const Variant& variant);

// What stands out of a panorama's light as its entry tells it, before any variant and any window.
// Errors: as variant_light().
Result<LightRecord> standout_lights(const Projection& projection, const PanoramaEntry& entry);

// The projection of an entry without a file: its lights in closed form, without any pixels.
[[nodiscard]] Projection lights_alone(const EntrySettings& settings);

}  // namespace shoal
