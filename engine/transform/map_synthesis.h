// Pictures from coefficients: the projection turned round.
#pragma once

#include <array>
#include <filesystem>
#include <memory>

#include "core/result.h"
#include "image/map_writer.h"
#include "kernels/row_moments.h"
#include "sphere/coefficients.h"
#include "sphere/frame.h"
#include "sphere/layout.h"
#include "sphere/legendre.h"

namespace shoal {

// Rows of the equirect picture of coefficients in the native frame, so that it lies as the panorama
// did:
//   f(theta_i, phi_j) = sum_m cos(m phi_j) a_m(theta_i) + sin(m phi_j) b_m(theta_i),
// with a_m, b_m summed over l in double, and the row made by the adjoint of the moment kernel.
// Samples are point samples at pixel centres. Accuracy: that of kernels::synthesise_row.
class EquirectSynthesis {
 public:
  // Preconditions: width, height >= 1, degree <= kMaxDegree.
  EquirectSynthesis(int width, int height, int degree);

  // One row of all channels; each plane holds `width` floats. Precondition: coefficients.degree is
  // the degree.
  void row(const Coefficients& coefficients, int row,
           const std::array<float*, kChannelCount>& planes);

 private:
  int height_;
  AssociatedLegendre<double> legendre_;
  std::vector<double> polar_;
  std::vector<double> moments_;  // (2L+1)
  kernels::RowMomentPlan plan_;
  kernels::RowMomentScratch scratch_;
};

// Writes a whole equirect map and commits it. Coefficients in the native frame.
Status write_equirect_map(const Coefficients& coefficients, const std::filesystem::path& path,
                          const MapFile& file);

// The light, in the native frame, whose cube maps have their faces named by the axes of `frame`
// instead of those of cube_frame().
[[nodiscard]] Coefficients facing(const Coefficients& native, const Frame& frame);

// Writes a map in any layout but equirect and commits it; texels that show nothing are black. Of
// cube_faces, one face: that of number `face`, which does not matter elsewhere. Of cube_openexr,
// the file says so by its envmap attribute. Coefficients in the native frame. Errors: usage (a size
// that the layout does not have; cube_openexr in another format), write_failed.
Status write_layout_map(const Coefficients& coefficients, Layout layout, int face,
                        const std::filesystem::path& path, const MapFile& file);

}  // namespace shoal
