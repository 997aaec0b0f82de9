// Irradiance by brute force: for each direction the integral over the hemisphere about it, texel by
// texel, without any spherical harmonics. Slow; what the fast figures are checked against.
#pragma once

#include <atomic>
#include <functional>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "core/result.h"
#include "image/panorama_source.h"
#include "transform/pixel_policy.h"

namespace shoal {

struct HemisphereSettings {
  PixelPolicy pixels;
  int threads = 1;
  // Called by one of the threads as rows are done, with their share of the picture. May be empty.
  std::function<void(double share)> progress;
};

// E(n) = integral of L(w) max(0, n.w) dw for every unit direction n of the native frame, of an
// equirect picture whose texels are each one radiance over their area, in linear Rec.709.
//
// A surface's horizon cuts a circle of latitude in at most one arc, so that at one theta
//   G = integral over the arc of L(phi) (n_x sin(theta) cos(phi) + n_y sin(theta) sin(phi)
//                                        + n_z cos(theta)) dphi
// is in closed form: whole columns by sums from the left edge, the two columns where the arc ends
// by their part. Over a row's theta, G sin(theta) is integrated by Gauss-Legendre nodes: to
// rounding where the horizon crosses none of its texels, elsewhere to the third power of the row's
// height. Error of E, of the picture's largest radiance: 2e-7 at 512 rows.
//
// Rows are added from the top, so the same bits come for any number of threads; each thread reads
// all of the picture for its share of the directions, a band at a time.
// Errors: unsupported (scanlines that are columns, pixels on the poles and the seam), pixels (the
// policy forbids what was met), interrupted, those of the reader.
Result<std::vector<glm::dvec3>> integrate_hemispheres(const PanoramaSource& source,
                                                      std::span<const glm::dvec3> directions,
                                                      const HemisphereSettings& settings,
                                                      const std::atomic<bool>& stop);

}  // namespace shoal
