// The twin: the same projection in long double, one basis function a pixel, no factorisation, no
// tables shared with the fast path. Slow, meant to be obviously correct; `--reference` selects it.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "sphere/basis.h"
#include "sphere/coefficients.h"
#include "sphere/legendre.h"
#include "sphere/quadrature.h"
#include "sphere/texel_mappings.h"

namespace shoal {

class ReferenceProjector {
 public:
  ReferenceProjector(const EquirectGrid& grid, Quadrature quadrature, int degree);

  // Adds one pixel to every coefficient: sample[c] * (integral, or weighted value, of Y_lm there).
  // Pixels of one row should come together; the polar part is computed when the row changes.
  void add_pixel(int row, int column, const std::array<float, kChannelCount>& sample);

  [[nodiscard]] Coefficients coefficients() const;

 private:
  void enter_row(int row);

  EquirectGrid grid_;
  Quadrature quadrature_;
  int degree_;
  int row_ = -1;
  AssociatedLegendre<long double> legendre_;
  std::vector<long double> polar_;  // legendre_index(l, m): of the current row
  std::vector<long double>
      azimuth_;  // (W, 2L+1): cos(m phi_j), then sin(m phi_j), times their weight
  std::array<std::vector<long double>, kChannelCount> sums_;
};

// The same for texels that look in any directions: sample * solid angle * Y_lm(direction).
class DirectionReference {
 public:
  explicit DirectionReference(int degree);

  void add_texel(const Texel& texel, const std::array<float, kChannelCount>& sample);

  [[nodiscard]] Coefficients coefficients() const;

 private:
  Basis<long double> basis_;
  std::vector<long double> values_;
  std::array<std::vector<long double>, kChannelCount> sums_;
};

}  // namespace shoal
