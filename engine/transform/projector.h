// From a panorama file to coefficients: bands -> row moments -> moment table -> contraction; for
// layouts that do not factor, bands -> sums over directions a row -> ordered sums.
//
// Order-invariant: every slot of the moment table is written once, by whichever worker reads its
// row, and rows are summed in a fixed order. The same bits for every number of workers, band
// height, order of bands and SIMD target.
// Accuracy: |dL_lm| <= 1e-6 * integral of |I Y_lm| against the reference twin.
#pragma once

#include <array>
#include <atomic>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/result.h"
#include "image/panorama_source.h"
#include "sphere/analytic_lights.h"
#include "sphere/coefficients.h"
#include "sphere/quadrature.h"
#include "transform/pixel_policy.h"
#include "transform/projection_settings.h"
#include "transform/projection_tables.h"
#include "transform/sun_light.h"

namespace shoal {

struct Projection {
  Coefficients
      radiance;  // native frame, linear Rec.709 (as far as the file says what its colours are)
  std::optional<Coefficients>
      finer;           // the same to quality_degree, where that is higher; begins with `radiance`
  EquirectGrid grid;   // of other layouts: their size
  std::string format;  // for people, with the layout where it is not equirect
  Quadrature quadrature = Quadrature::texel;  // the one really used
  double solid_angle = 0.0;                   // what the weights sum to
  PixelReport pixels;
  std::optional<Sun> sun;  // where one was asked for and found; linear Rec.709
  // What the file or its name said of its layout, which is not equirect; else empty. A sentence.
  std::string recognised_layout;
  std::vector<std::string> warnings;
};

// A panorama that is no file.
struct PaintedPanorama {
  std::string name;                        // what errors call it
  std::unique_ptr<PanoramaSource> source;  // equirect
  // What pixels would blur: added to their projection in closed form, at any degree. Native frame.
  std::vector<AnalyticLight> lights;
};

// One panorama on its way. Made by one worker, fed by any number, finished by one.
class PanoramaProjection {
 public:
  static Result<std::unique_ptr<PanoramaProjection>> open(const std::filesystem::path& path,
                                                          const ReadOptions& options,
                                                          const ProjectionSettings& settings,
                                                          ProjectionTables& tables);
  // The same of a painted one, whose layout the settings do not change.
  static std::unique_ptr<PanoramaProjection> open(PaintedPanorama panorama,
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
