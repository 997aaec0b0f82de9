// A panorama's light in a variant: everything linear, applied to its projection.
#pragma once

#include <glm/mat3x3.hpp>
#include <vector>

#include "batch/manifest.h"
#include "core/result.h"
#include "output/light_table.h"
#include "sphere/coefficients.h"
#include "sphere/light_quality.h"
#include "transform/projector.h"

namespace shoal {

struct VariantLight {
  Coefficients radiance;      // native frame
  std::vector<double> gains;  // of the window, a degree; all 1 where there is none
};

// A panorama's light in its variants, one after the other. An automatic window is fitted once for
// all variants that only turn the same light: a turn moves what is least, but does not change it.
class VariantLights {
 public:
  // Both are kept by reference.
  VariantLights(const Projection& projection, const PanoramaEntry& entry)
      : projection_(projection), entry_(entry) {}

  // In this order: the file's light, mirrored, and the entry's lights together, white balance,
  // matrix, scale and exposure, the rotation, the dominant light taken out or alone, the window.
  // What is not asked for leaves the bits as they are; so do the variants that were asked before.
  // Errors: usage (linear keys that make no sense; an automatic window of light whose mean is not
  // positive).
  Result<VariantLight> in(const Variant& variant);

  // The figures of what in(variant) returned. They tell errors where the projection knows the light
  // any finer than the entry's degree. Errors: as in().
  [[nodiscard]] Result<LightQuality> quality(const Variant& variant,
                                             const VariantLight& light) const;

 private:
  struct Fit {
    glm::dmat3 matrix;  // of the colours
    glm::dmat3 mirror;  // of the file's light, to which others are added
    DominantPart dominant;
    std::vector<double> gains;
  };
  Result<std::vector<double>> gains_of(const Variant& variant);

  const Projection& projection_;
  const PanoramaEntry& entry_;
  std::vector<Fit> fits_;
};

// What stands out of a panorama's light as its entry tells it, before any variant and any window.
// Errors: as VariantLights.
Result<LightRecord> standout_lights(const Projection& projection, const PanoramaEntry& entry);

// The projection of an entry without a file: its lights in closed form, without any pixels.
[[nodiscard]] Projection lights_alone(const EntrySettings& settings);

}  // namespace shoal
