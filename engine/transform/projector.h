// From a panorama file to coefficients: bands -> row moments -> moment table -> contraction.
//
// Order-invariant: every slot of the moment table is written once, by whichever worker reads its
// row, and the contraction sums rows in a fixed order. The same bits for every number of workers,
// band height, order of bands and SIMD target.
// Accuracy: |dL_lm| <= 1e-6 * integral of |I Y_lm| against the reference twin.
#pragma once

#include <array>
#include <atomic>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "core/result.h"
#include "image/panorama_source.h"
#include "sphere/coefficients.h"
#include "sphere/quadrature.h"
#include "transform/pixel_policy.h"
#include "transform/projection_tables.h"

namespace shoal {

enum class Arithmetic {
  kernels,    // SIMD row moments
  reference,  // the long-double twin: a basis function a pixel, slow, obviously correct
};

struct ProjectionSettings {
  int degree = 2;
  Quadrature quadrature = Quadrature::texel;
  PixelPolicy pixels;
  Arithmetic arithmetic = Arithmetic::kernels;
};

struct Projection {
  Coefficients
      radiance;  // native frame, linear Rec.709 (as far as the file says what its colours are)
  EquirectGrid grid;
  std::string format;
  Quadrature quadrature = Quadrature::texel;  // the one really used
  double solid_angle = 0.0;                   // what the weights sum to
  PixelReport pixels;
  std::vector<std::string> warnings;
};

// One panorama on its way. Made by one worker, fed by any number, finished by one.
class PanoramaProjection {
 public:
  static Result<std::unique_ptr<PanoramaProjection>> open(const std::filesystem::path& path,
                                                          const ReadOptions& options,
                                                          const ProjectionSettings& settings,
                                                          ProjectionTables& tables);
  ~PanoramaProjection();

  [[nodiscard]] const PictureInfo& info() const;

  // Takes bands until none is left or one fails; any number of workers may do so at once.
  // `stop` ends it early, with ErrorCode::interrupted. `pixels_done` grows as bands are done.
  Status work(const std::atomic<bool>& stop, std::atomic<std::int64_t>& pixels_done);

  // Whether one more worker would find bands to take.
  [[nodiscard]] bool wants_workers() const;

  // Seconds that all workers together spent so far on reading bands and on projecting them.
  struct Seconds {
    double reading = 0.0;
    double projecting = 0.0;
  };
  [[nodiscard]] Seconds seconds() const;

  // After every work() has returned, and all without error. Errors: pixels (the policy forbids what
  // was met: how many, and where the first is).
  Result<Projection> finish();

 private:
  PanoramaProjection();
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

// All of it in the calling thread.
Result<Projection> project_panorama(const std::filesystem::path& path, const ReadOptions& options,
                                    const ProjectionSettings& settings, ProjectionTables& tables);

}  // namespace shoal
