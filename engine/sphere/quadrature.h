// How the pixels of an equirect picture are weighted when its integral over the sphere is taken.
//
// Sources: Waldvogel, "Fast Construction of the Fejer and Clenshaw-Curtis Quadrature Rules", BIT 46
// (2006); the texel model is derived in quadrature.cpp.
#pragma once

#include <cstddef>
#include <string_view>
#include <vector>

#include "core/result.h"

namespace shoal {

// Where a picture's pixels lie.
enum class Sampling {
  centers,    // theta_i = pi (i+1/2)/H, phi_j = 2 pi (j+1/2)/W: every ordinary panorama
  endpoints,  // theta_i = pi i/(H-1), phi_j = 2 pi j/(W-1): first and last row on the poles, first
              // and last column the same meridian (OpenEXR's envmap LATLONG)
};

enum class Quadrature {
  texel,     // a pixel is the average over its area; exact for piecewise constant pictures
  midpoint,  // the textbook double sum: sin(theta_i) dtheta dphi
  fejer,     // a pixel is a point sample; exact for band-limited ones, l + l' <= H-1, W >= 2L+1
  clenshaw_curtis,  // the counterpart of fejer on endpoints, and the only one there
};

// "texel", "midpoint", "fejer", "clenshaw-curtis".
[[nodiscard]] std::string_view name_of(Quadrature quadrature);

// The quadrature of such a name. Error: usage, with the nearest name.
[[nodiscard]] Result<Quadrature> parse_quadrature(std::string_view name);

struct EquirectGrid {
  int width = 0;
  int height = 0;
  Sampling sampling = Sampling::centers;

  friend bool operator==(const EquirectGrid&, const EquirectGrid&) = default;
};

// The quadrature that really is used when `asked` is asked for on `sampling`: on endpoints always
// clenshaw_curtis; on centers, where that has no nodes, fejer stands in for it.
[[nodiscard]] Quadrature effective_quadrature(Quadrature asked, Sampling sampling);

// phi_j = 2 pi (first + step j) / turn, with integers so that m phi_j reduces exactly.
struct ColumnAngles {
  int first = 1;
  int step = 2;
  int turn = 0;
  double edge_weight = 1.0;  // weight of the first and of the last column; 1/2 counts a seam once
};

[[nodiscard]] ColumnAngles column_angles(const EquirectGrid& grid);

// The polar angle of a row of the grid. cos_theta is exactly zero on the equator and changes only
// its sign in the mirrored row; sin_theta and cos_theta are exactly 0 and +-1 on a pole.
struct PolarAngle {
  long double cos_theta = 1;
  long double sin_theta = 0;
};

// Precondition: 0 <= row < height.
[[nodiscard]] PolarAngle row_angle(const EquirectGrid& grid, int row);

// The separated weights of one grid:
//   L_lm = azimuth[|m|] * sum_i polar(l, |m|, i) * (m >= 0 ? C_m[i] : S_|m|[i])
// with row moments C_m[i] = sum_j w_j I[i,j] cos(m phi_j), S_m likewise with sin.
//
// Only rows of the northern half and the equator are stored, northern_rows = ceil(height/2);
// polar(l, m, height-1-i) = (-1)^(l+m) polar(l, m, i). So a consumer that folds the two halves,
// C+-[i] = C[i] +- C[height-1-i], does so for i < height/2 only (rounded down). An odd height has
// one row more, i = northern_rows-1, the equator: its own mirror, it enters once and unfolded. Its
// weights are whole, and exactly zero where l+m is odd.
struct ProjectionWeights {
  int degree = 0;
  EquirectGrid grid;
  Quadrature quadrature = Quadrature::texel;
  int northern_rows = 0;
  std::vector<double> polar;    // ((L+1)(L+2)/2, northern_rows), first index l(l+1)/2 + m
  std::vector<double> azimuth;  // (L+1)
  // What the weights of all pixels sum to; 4 pi to 1e-14 relative for all but midpoint.
  double solid_angle = 0.0;

  [[nodiscard]] const double* polar_row_weights(int l, int m) const {
    return polar.data() + static_cast<std::size_t>(l * (l + 1) / 2 + m) * northern_rows;
  }
};

// Preconditions: width, height >= 1 (>= 2 for endpoints), 0 <= degree <= kMaxDegree. Error of a
// polar weight, of pi/height times the largest |Pbar_lm sin(theta)|: 1e-14 to degree 16, 5e-14 at
// degree 64.
[[nodiscard]] ProjectionWeights make_projection_weights(const EquirectGrid& grid,
                                                        Quadrature quadrature, int degree);

}  // namespace shoal
