// Operations on coefficients that stand for operations on every pixel.
#pragma once

#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>
#include <optional>

#include "core/result.h"
#include "sphere/coefficients.h"

namespace shoal {

// Luminance of linear Rec.709 R, G, B: 0.2126 R + 0.7152 G + 0.0722 B (ITU-R BT.709-6, item 3.2).
[[nodiscard]] double luminance(const glm::dvec3& rgb);

// The luminance of coefficient i.
[[nodiscard]] double luminance(const Coefficients& coefficients, int i);

// What a panorama's colours go through, in this order: white balance, matrix, scale and exposure.
struct ColourOperations {
  double exposure_stops = 0.0;        // times 2^stops
  double scale = 1.0;                 // and times this
  glm::dmat3 matrix{1.0};             // new (r,g,b) column = matrix * (r,g,b) column
  std::optional<glm::dvec3> white{};  // linear Rec.709; becomes the grey of its luminance
};

// All of it as one matrix. Exactly the identity when nothing is asked for. The white balance
// multiplies channel c by Y(white)/white_c, Y = 0.2126 r + 0.7152 g + 0.0722 b.
// Errors: usage, where a component of the white is not positive and finite, or the matrix that
// comes out is not finite.
[[nodiscard]] Result<glm::dmat3> combined_matrix(const ColourOperations& operations);

// matrix * (r,g,b) at every coefficient. The identity leaves the bits as they are; a diagonal
// matrix multiplies each channel and adds nothing.
[[nodiscard]] Coefficients apply_matrix(Coefficients coefficients, const glm::dmat3& matrix);

// The light of both together. Precondition: the same degree.
[[nodiscard]] Coefficients add(Coefficients a, const Coefficients& b);

// The coefficients to `degree`, or all where they end before. Precondition: degree >= 0.
[[nodiscard]] Coefficients truncate(Coefficients coefficients, int degree);

}  // namespace shoal
