// What a projection depends on besides its file.
#pragma once

#include <algorithm>

#include "sphere/layout.h"
#include "sphere/quadrature.h"
#include "transform/pixel_policy.h"
#include "transform/sun_light.h"

namespace shoal {

enum class Arithmetic {
  kernels,    // SIMD row moments, or sums over directions
  reference,  // the long-double twin: a basis function a pixel, slow, obviously correct
};

struct ProjectionSettings {
  int degree = 2;
  // The degree to which light is to be known besides, for figures of quality; what is not above
  // `degree` asks for nothing. It changes no bit of the coefficients to `degree`.
  int quality_degree = 0;
  Quadrature quadrature = Quadrature::texel;  // of equirect pictures; others: midpoint
  // Of pictures that do not say themselves what they are, as an EXR's envmap attribute does.
  Layout layout = Layout::equirect;
  PixelPolicy pixels;
  SunSettings sun;
  Arithmetic arithmetic = Arithmetic::kernels;

  [[nodiscard]] int highest_degree() const { return std::max(degree, quality_degree); }
};

}  // namespace shoal
