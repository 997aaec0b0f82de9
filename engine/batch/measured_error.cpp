#include "batch/measured_error.h"

#include <utility>

#include "transform/hemisphere_integral.h"
#include "transform/layout_source.h"
#include "transform/simd_codecs.h"

namespace shoal {

Result<std::optional<IrradianceError>> measured_error(const std::string& file,
                                                      const Coefficients& radiance,
                                                      const ProjectionSettings& settings, int rows,
                                                      int threads,
                                                      std::function<void(double share)> progress,
                                                      const std::atomic<bool>& stop) {
  SHOAL_ASSIGN_OR_RETURN(picture, open_picture(file, {}, simd_chunk_codecs(), settings.layout));
  if (picture.layout != Layout::equirect) {
    return Error{ErrorCode::unsupported, "brute force takes equirect pictures only", file,
                 "leave --brute-force out"};
  }
  const HemisphereSettings hemisphere{settings.pixels, threads, std::move(progress)};
  const DirectionGrid grid = gauss_grid(rows);
  auto irradiance = integrate_hemispheres(*picture.source, grid.directions, hemisphere, stop);
  if (irradiance) return irradiance_error(radiance, grid, *irradiance);
  Error error = std::move(irradiance).error();
  if (error.where.empty()) error.where = file;
  return error;
}

}  // namespace shoal
