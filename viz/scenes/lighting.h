// The light that a surface gets: from nine coefficients, and from every texel.
#pragma once

#include <array>
#include <glm/mat3x3.hpp>
#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "library/pixels.h"
#include "sphere/coefficients.h"

namespace shoal::viz {

// The matrix M of the quadratic form n^T M n, n = (x, y, z, 1) of a unit normal, that is the
// irradiance of one channel of radiance to degree 2. `radiance` holds at least nine coefficients.
// Source: Ramamoorthi & Hanrahan, "An Efficient Representation for Irradiance Environment Maps",
// SIGGRAPH 2001, eq. 11-12; their c_1 ... c_5 are clamped_cosine_gain times the factors of Y_lm.
[[nodiscard]] glm::dmat4 quadratic_form(std::span<const double> radiance);

// The three channels' forms.
class IrradianceForm {
 public:
  // Of radiance coefficients; those above degree 2 do not count.
  explicit IrradianceForm(const Coefficients& radiance);

  // RGB; the normal is of unit length, in the coefficients' frame.
  [[nodiscard]] glm::dvec3 irradiance(const glm::dvec3& normal) const;

 private:
  std::array<glm::dmat4, kChannelCount> forms_;
};

// The integral over the hemisphere, from every texel. A texel's light counts as if it came from its
// centre; its solid angle is exact.
//
// The cosine is linear in the direction, so what lies before a surface as a whole lights it as the
// sum of flux times direction does, exactly. Such sums are kept of cells of 1.4 degrees and of
// larger blocks of them, two by two; only blocks that the surface's horizon passes through are
// looked into. A cell there counts as one light in its mean direction. For even light, which passes
// through it to a part 0 to 1, that adds less than h^2/4 of its irradiance, h = 0.0245 the cell's
// side: 1.5e-4; light of a few texels is hardly touched.
class TexelLight {
 public:
  // What is in native direction d of the pixels shines from to_normals * d, in the space that
  // normals are going to be of: native_to_frame(frame), or that after a rotation of the light.
  TexelLight(const Pixels& pixels, const glm::dmat3& to_normals);

  // RGB; the normal is of unit length.
  [[nodiscard]] glm::dvec3 irradiance(const glm::dvec3& normal) const;

 private:
  struct Block {
    glm::dvec3 center{0.0};
    double reach = 0.0;    // sine of an angle around the centre within which all of it lies
    glm::dmat3 flux{0.0};  // column c: the sum of channel c's radiance, solid angle and direction
  };
  struct Level {
    int width = 0;
    int height = 0;
    std::vector<Block> blocks;
  };
  static Level cells_of(const Pixels& pixels, const glm::dmat3& to_normals);
  static Level coarser(const Level& fine);
  void add(std::size_t level, int row, int column, const glm::dvec3& normal, glm::dvec3& sum) const;

  std::vector<Level> levels_;  // the cells first
};

}  // namespace shoal::viz
