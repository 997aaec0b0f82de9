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

// The integral over the hemisphere, texel by texel. A texel's light counts as if it came from its
// centre; its solid angle is exact.
class TexelLight {
 public:
  // What is in native direction d of the pixels shines from to_normals * d, in the space that
  // normals are going to be of: native_to_frame(frame), or that after a rotation of the light.
  TexelLight(const Pixels& pixels, const glm::dmat3& to_normals);

  [[nodiscard]] glm::dvec3 irradiance(const glm::dvec3& normal) const;

 private:
  std::vector<glm::dvec3> directions_;
  std::vector<glm::dvec3> flux_;  // radiance times solid angle
};

}  // namespace shoal::viz
