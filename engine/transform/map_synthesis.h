// Pictures from coefficients: the projection turned round.
#pragma once

#include <array>
#include <filesystem>
#include <glm/vec3.hpp>
#include <memory>

#include "core/result.h"
#include "image/map_writer.h"
#include "kernels/row_moments.h"
#include "sphere/coefficients.h"
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

// The direction, in the cube's own axes, of the centre of texel (column, row) of one of its faces,
// numbered +x -x +y -y +z -z and laid out as OpenGL and Direct3D do (OpenGL 4.6 specification,
// table 8.19).
[[nodiscard]] glm::dvec3 cube_direction(int face, int size, int row, int column);

// Writes a whole equirect map and commits it. Coefficients in the native frame.
Status write_equirect_map(const Coefficients& coefficients, const std::filesystem::path& path,
                          const MapFile& file);

// How the six faces of a cube lie in pictures.
enum class CubePacking {
  strip,  // one picture of 6N x N, the faces side by side in their order
  face,   // one face a picture
};

// Writes one picture of a cube map: the strip, or the face of number `face`. file.height is the
// size of a face. Coefficients in the frame whose axes the faces are named by.
Status write_cube_map(const Coefficients& coefficients, CubePacking packing, int face,
                      const std::filesystem::path& path, const MapFile& file);

}  // namespace shoal
