// The texel model. A pixel holds the average of the radiance over its area, so the picture is a
// piecewise constant function and its projection
//   L_lm = sum_ij I[i,j] integral over row i of Pbar_lm(cos t) sin(t) dt
//                        * integral over column j of cos(m phi) d phi
// needs no further assumption. The column's integral is cos(m phi_j) 2 sin(m pi/W)/m: the point's
// value times one factor an order. The row's integrand is a trigonometric polynomial of degree L+1,
// which Gauss-Legendre nodes inside the row integrate to rounding: gauss_legendre_count says how
// many. For l = 0 the integral of sin(t) is 2 sin(theta_i) sin(pi/2H), without the cancellation of
// a difference of cosines.
#include "sphere/quadrature.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <span>
#include <string>

#include "core/diagnostic.h"
#include "sphere/conventions.h"
#include "sphere/gauss_legendre.h"
#include "sphere/legendre.h"
#include "sphere/polar_rules.h"

namespace shoal {
namespace {

constexpr long double kPi = std::numbers::pi_v<long double>;

constexpr std::array<std::string_view, 4> kNames = {"texel", "midpoint", "fejer",
                                                    "clenshaw-curtis"};

// Weights of one row: values[legendre_index(l, m)] = sum over nodes of weight * Pbar_lm(node).
class RowWeights {
 public:
  RowWeights(const EquirectGrid& grid, Quadrature quadrature, int degree)
      : grid_(grid), quadrature_(quadrature), legendre_(degree), pbar_(legendre_count(degree)) {
    if (quadrature == Quadrature::fejer) point_weights_ = fejer_weights(grid.height);
    if (quadrature == Quadrature::clenshaw_curtis) {
      point_weights_ = clenshaw_curtis_weights(grid.height);
    }
    if (quadrature == Quadrature::texel) make_texel_nodes();
  }

  void make(int row, std::span<double> values) {
    std::fill(values.begin(), values.end(), 0.0);
    const PolarAngle angle = row_angle(grid_, row);
    switch (quadrature_) {
      case Quadrature::texel:
        add_texel_row(angle, values);
        break;
      case Quadrature::midpoint:
        add_node(angle, angle.sin_theta * kPi / grid_.height, values);
        break;
      case Quadrature::fejer:
      case Quadrature::clenshaw_curtis:
        add_node(angle, point_weights_[row], values);
        break;
    }
  }

 private:
  // Offsets from the row's middle, the non-negative half of a symmetric rule.
  struct TexelNode {
    long double sin_offset, cos_offset, weight;
  };

  void make_texel_nodes() {
    const long double half_row = kPi / (2.0L * grid_.height);
    zonal_factor_ = std::sqrt(std::numbers::inv_pi_v<long double>) * std::sin(half_row);
    const int turns = legendre_.degree() + 1;
    const GaussRule rule =
        gauss_legendre(gauss_legendre_count(static_cast<double>(turns * half_row)));
    for (std::size_t k = rule.nodes.size() / 2; k < rule.nodes.size(); ++k) {
      const long double offset = rule.nodes[k] * half_row;
      nodes_.push_back({std::sin(offset), std::cos(offset), rule.weights[k] * half_row});
    }
  }

  void add_node(const PolarAngle& angle, long double weight, std::span<double> values) {
    legendre_.evaluate(static_cast<double>(angle.cos_theta), static_cast<double>(angle.sin_theta),
                       pbar_);
    const double w = static_cast<double>(weight);
    for (std::size_t i = 0; i < values.size(); ++i) values[i] += w * pbar_[i];
  }

  // Two nodes at equal distance follow each other, so that on the equator what is odd cancels
  // exactly.
  void add_texel_row(const PolarAngle& middle, std::span<double> values) {
    for (const TexelNode& node : nodes_) {
      const long double sin_middle = middle.sin_theta * node.cos_offset;
      const long double cos_middle = middle.cos_theta * node.cos_offset;
      const long double sin_shift = middle.cos_theta * node.sin_offset;
      const long double cos_shift = middle.sin_theta * node.sin_offset;
      const PolarAngle north{cos_middle + cos_shift, sin_middle - sin_shift};
      add_node(north, north.sin_theta * node.weight, values);
      if (node.sin_offset == 0) continue;
      const PolarAngle south{cos_middle - cos_shift, sin_middle + sin_shift};
      add_node(south, south.sin_theta * node.weight, values);
    }
    values[0] = static_cast<double>(zonal_factor_ * middle.sin_theta);
  }

  EquirectGrid grid_;
  Quadrature quadrature_;
  AssociatedLegendre<double> legendre_;
  std::vector<double> pbar_;
  std::vector<long double> point_weights_;
  long double zonal_factor_ = 0;  // 2 Pbar_00 sin(pi/2H)
  std::vector<TexelNode> nodes_;
};

std::vector<double> make_polar_weights(const EquirectGrid& grid, Quadrature quadrature,
                                       int degree) {
  const int rows = (grid.height + 1) / 2;
  const int count = legendre_count(degree);
  std::vector<double> polar(static_cast<std::size_t>(count) * rows);
  RowWeights row_weights(grid, quadrature, degree);
  // Rows are made across the table's lines: a cache line's worth of them at a time.
  constexpr int kBlock = 8;
  std::vector<double> block(static_cast<std::size_t>(count) * kBlock);
  for (int begin = 0; begin < rows; begin += kBlock) {
    const int end = std::min(begin + kBlock, rows);
    for (int i = begin; i < end; ++i) {
      row_weights.make(
          i, std::span(block).subspan(static_cast<std::size_t>(i - begin) * count, count));
    }
    for (int lm = 0; lm < count; ++lm) {
      for (int i = begin; i < end; ++i) {
        polar[static_cast<std::size_t>(lm) * rows + i] =
            block[static_cast<std::size_t>(i - begin) * count + lm];
      }
    }
  }
  return polar;
}

std::vector<double> make_azimuth_factors(const EquirectGrid& grid, Quadrature quadrature,
                                         int degree) {
  const int turn = grid.sampling == Sampling::endpoints ? grid.width - 1 : grid.width;
  const long double spacing = 2 * kPi / turn;
  std::vector<double> azimuth(degree + 1, static_cast<double>(spacing));
  if (quadrature != Quadrature::texel) return azimuth;
  for (int m = 1; m <= degree; ++m) {
    const bool whole_waves = m % turn == 0;
    azimuth[m] =
        whole_waves ? 0.0 : static_cast<double>(2 * std::sin(kPi * (m % (2 * turn)) / turn) / m);
  }
  return azimuth;
}

// A picture of ones projects to solid_angle Y_00.
double sum_of_weights(const ProjectionWeights& weights) {
  long double rows = 0;
  for (int i = 0; i < weights.grid.height / 2; ++i) rows += 2.0L * weights.polar[i];
  if (weights.grid.height % 2 == 1) rows += weights.polar[weights.northern_rows - 1];
  const ColumnAngles columns = column_angles(weights.grid);
  const bool seam = weights.grid.sampling == Sampling::endpoints;
  const long double column_sum =
      seam ? weights.grid.width - 2 + 2 * columns.edge_weight : weights.grid.width;
  return static_cast<double>(rows * column_sum * weights.azimuth[0] * std::sqrt(4 * kPi));
}

}  // namespace

std::string_view name_of(Quadrature quadrature) { return kNames[static_cast<int>(quadrature)]; }

Result<Quadrature> parse_quadrature(std::string_view name) {
  const auto found = std::find(kNames.begin(), kNames.end(), name);
  if (found != kNames.end()) return static_cast<Quadrature>(found - kNames.begin());
  const std::string_view near = closest_match(name, kNames);
  return Error{ErrorCode::usage, "unknown quadrature \"" + std::string(name) + "\"", "",
               near.empty() ? "use texel, midpoint or fejer"
                            : "did you mean \"" + std::string(near) + "\"?"};
}

Quadrature effective_quadrature(Quadrature asked, Sampling sampling) {
  if (sampling == Sampling::endpoints) return Quadrature::clenshaw_curtis;
  return asked == Quadrature::clenshaw_curtis ? Quadrature::fejer : asked;
}

ColumnAngles column_angles(const EquirectGrid& grid) {
  if (grid.sampling == Sampling::endpoints) return {0, 1, grid.width - 1, 0.5};
  return {1, 2, 2 * grid.width, 1.0};
}

PolarAngle row_angle(const EquirectGrid& grid, int row) {
  // theta = pi (2i+1)/(2H) or pi (2i)/(2(H-1)); the cosine is the sine of what is left to the
  // equator.
  const bool endpoints = grid.sampling == Sampling::endpoints;
  const int rows = endpoints ? grid.height - 1 : grid.height;
  const int steps = endpoints ? 2 * row : 2 * row + 1;
  const int to_pole = std::min(steps, 2 * rows - steps);
  return {std::sin(kPi * (rows - steps) / (2.0L * rows)), std::sin(kPi * to_pole / (2.0L * rows))};
}

ProjectionWeights make_projection_weights(const EquirectGrid& grid, Quadrature quadrature,
                                          int degree) {
  ProjectionWeights weights;
  weights.degree = degree;
  weights.grid = grid;
  weights.quadrature = effective_quadrature(quadrature, grid.sampling);
  weights.northern_rows = (grid.height + 1) / 2;
  weights.polar = make_polar_weights(grid, weights.quadrature, degree);
  weights.azimuth = make_azimuth_factors(grid, weights.quadrature, degree);
  weights.solid_angle = sum_of_weights(weights);
  return weights;
}

}  // namespace shoal
