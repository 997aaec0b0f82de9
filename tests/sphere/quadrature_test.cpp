#include "sphere/quadrature.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "sphere/basis.h"
#include "sphere/gauss_legendre.h"
#include "sphere/legendre.h"

namespace shoal {
namespace {

constexpr long double kPi = std::numbers::pi_v<long double>;
constexpr double kSphere = 4 * std::numbers::pi;

EquirectGrid grid_of(int height, Sampling sampling = Sampling::centers) {
  return {2 * height, height, sampling};
}

// The weight of any row, southern ones by the rule of the header.
double polar(const ProjectionWeights& weights, int l, int m, int row) {
  const double* stored = weights.polar_row_weights(l, m);
  if (row < weights.northern_rows) return stored[row];
  return ((l + m) % 2 == 0 ? 1 : -1) * stored[weights.grid.height - 1 - row];
}

std::vector<int> heights_of_all_kinds() {
  std::vector<int> heights = {255, 256, 257, 1000, 1024, 2047, 4096, 8192, 16383, 16384};
  for (int h = 1; h <= 70; ++h) heights.push_back(h);
  return heights;
}

TEST(Quadrature, WeightsSumToTheSphere) {
  for (int height : heights_of_all_kinds()) {
    for (Quadrature quadrature : {Quadrature::texel, Quadrature::fejer}) {
      for (int width : {1, 3, 2 * height}) {
        const double sum = make_projection_weights({width, height}, quadrature, 0).solid_angle;
        EXPECT_NEAR(sum / kSphere, 1.0, 1e-14) << name_of(quadrature) << ' ' << height;
      }
    }
    if (height < 2) continue;
    const double sum = make_projection_weights(grid_of(height, Sampling::endpoints),
                                               Quadrature::clenshaw_curtis, 0)
                           .solid_angle;
    EXPECT_NEAR(sum / kSphere, 1.0, 1e-14) << "clenshaw-curtis " << height;
  }
}

// sum of sin(theta_i) = 1/sin(x) with x = pi/2H, so that the midpoint sum is x/sin(x) of the
// sphere: too much by x^2/6 + 7 x^4/360 + ...
TEST(Quadrature, MidpointExceedsTheSphere) {
  for (int height : heights_of_all_kinds()) {
    const double x = std::numbers::pi / (2 * height);
    const double excess =
        make_projection_weights(grid_of(height), Quadrature::midpoint, 0).solid_angle / kSphere - 1;
    EXPECT_NEAR(excess, x / std::sin(x) - 1, 1e-14) << height;
    EXPECT_NEAR(excess, x * x / 6, 0.03 * x * x * x * x + 1e-14) << height;
  }
}

// What solid_angle reports is what the stored weights give a picture of ones, pixel by pixel.
TEST(Quadrature, SolidAngleIsThatOfAPictureOfOnes) {
  for (Sampling sampling : {Sampling::centers, Sampling::endpoints}) {
    for (int height : {2, 3, 8, 9}) {
      const EquirectGrid grid{5, height, sampling};
      const ProjectionWeights weights = make_projection_weights(grid, Quadrature::midpoint, 3);
      const ColumnAngles columns = column_angles(grid);
      double sum = 0.0;
      for (int i = 0; i < height; ++i) {
        for (int j = 0; j < grid.width; ++j) {
          const bool edge = j == 0 || j == grid.width - 1;
          sum += (edge ? columns.edge_weight : 1.0) * polar(weights, 0, 0, i) * weights.azimuth[0];
        }
      }
      EXPECT_NEAR(weights.solid_angle, sum * std::sqrt(kSphere), 1e-14 * sum);
    }
  }
}

// Integrals of Pbar_lm(cos t) sin(t) over row i for all (l, m), by 16 nodes on each of as many
// panels as make the integrand, of degree l+1, turn by less than half a wave in one.
std::vector<long double> row_integrals(const AssociatedLegendre<long double>& legendre, int height,
                                       int row) {
  static const GaussRule rule = gauss_legendre(16);
  const int panels = 1 + (legendre.degree() + 1) / height;
  std::vector<long double> p(legendre_count(legendre.degree())), sums(p.size());
  const long double half = kPi / (2.0L * height * panels);
  for (int panel = 0; panel < panels; ++panel) {
    const long double middle = kPi * row / height + (2 * panel + 1) * half;
    for (std::size_t k = 0; k < rule.nodes.size(); ++k) {
      const long double t = middle + half * rule.nodes[k];
      legendre.evaluate(std::cos(t), std::sin(t), p);
      for (std::size_t i = 0; i < p.size(); ++i)
        sums[i] += rule.weights[k] * half * p[i] * std::sin(t);
    }
  }
  return sums;
}

// pi/height times the largest |Pbar_lm sin(theta)|: the scale of the header's bound. The integrals
// over a few coarse rows may be far smaller, because they cancel.
std::vector<double> weight_scales(int degree, int height) {
  const AssociatedLegendre<double> legendre(degree);
  std::vector<double> p(legendre_count(degree)), scales(p.size());
  for (int i = 0; i <= 1000; ++i) {
    const double theta = std::numbers::pi * i / 2000;
    legendre.evaluate(std::cos(theta), std::sin(theta), p);
    for (std::size_t k = 0; k < p.size(); ++k) {
      scales[k] = std::max(scales[k], std::abs(p[k]) * std::sin(theta) * std::numbers::pi / height);
    }
  }
  return scales;
}

TEST(TexelWeights, AreTheIntegralsOverTheRows) {
  struct Case {
    int height, degree;
    double tolerance;  // the header's
  };
  for (const Case& c : {Case{1, 16, 1e-14}, Case{2, 16, 1e-14}, Case{7, 16, 1e-14},
                        Case{64, 16, 1e-14}, Case{501, 16, 1e-14}, Case{1, 64, 5e-14},
                        Case{5, 64, 5e-14}, Case{40, 64, 5e-14}, Case{301, 64, 5e-14}}) {
    const ProjectionWeights weights =
        make_projection_weights(grid_of(c.height), Quadrature::texel, c.degree);
    const AssociatedLegendre<long double> legendre(c.degree);
    const std::vector<double> scales = weight_scales(c.degree, c.height);
    for (int i = 0; i < c.height; ++i) {
      const std::vector<long double> exact = row_integrals(legendre, c.height, i);
      for (int l = 0; l <= c.degree; ++l) {
        for (int m = 0; m <= l; ++m) {
          const int k = legendre_index(l, m);
          EXPECT_NEAR(polar(weights, l, m, i), static_cast<double>(exact[k]),
                      c.tolerance * scales[k])
              << "height " << c.height << " row " << i << " l " << l << " m " << m;
        }
      }
    }
  }
}

// The area of a row is the area of its halves, and so is every integral over it: a theorem that
// uses no other quadrature and reaches all degrees and orders.
TEST(TexelWeights, AddUpWhenRowsAreSplit) {
  for (int height : {1, 2, 15, 128, 1023}) {
    const ProjectionWeights coarse =
        make_projection_weights(grid_of(height), Quadrature::texel, kMaxDegree);
    const ProjectionWeights fine =
        make_projection_weights(grid_of(2 * height), Quadrature::texel, kMaxDegree);
    const std::vector<double> scales = weight_scales(kMaxDegree, height);
    for (int l = 0; l <= kMaxDegree; ++l) {
      for (int m = 0; m <= l; ++m) {
        double error = 0.0;
        for (int i = 0; i < height; ++i) {
          const double halves = polar(fine, l, m, 2 * i) + polar(fine, l, m, 2 * i + 1);
          error = std::max(error, std::abs(polar(coarse, l, m, i) - halves));
        }
        // The errors of both tables.
        EXPECT_LE(error, 1e-13 * scales[legendre_index(l, m)]) << height << ' ' << l << ' ' << m;
      }
    }
  }
}

// One row from pole to pole: the integral of Pbar_lm over the sphere's meridian. l = 0 gives 2
// Pbar_00, odd l+m nothing at all, P_11 the integral of sin^2, pi/2, and m = 0 nothing but l = 0.
TEST(TexelWeights, OneRow) {
  const ProjectionWeights weights = make_projection_weights({4, 1}, Quadrature::texel, kMaxDegree);
  ASSERT_EQ(weights.northern_rows, 1);
  EXPECT_DOUBLE_EQ(polar(weights, 0, 0, 0), 2 / std::sqrt(kSphere));
  EXPECT_DOUBLE_EQ(polar(weights, 1, 1, 0), std::sqrt(3 / kSphere) * std::numbers::pi / 2);
  for (int l = 1; l <= kMaxDegree; ++l) {
    EXPECT_NEAR(polar(weights, l, 0, 0), 0.0, 1e-14) << l;
    for (int m = (l + 1) % 2; m <= l; m += 2) EXPECT_EQ(polar(weights, l, m, 0), 0.0);
  }
}

// The integral of cos(m phi) over column j is azimuth[m] cos(m phi_j), of sin likewise.
TEST(TexelWeights, AzimuthFactorIsTheIntegralOverAColumn) {
  for (int width : {1, 2, 3, 7, 64, 65}) {
    const ProjectionWeights weights =
        make_projection_weights({width, 2}, Quadrature::texel, kMaxDegree);
    const ColumnAngles columns = column_angles(weights.grid);
    for (int m = 1; m <= kMaxDegree; ++m) {
      for (int j = 0; j < width; ++j) {
        const long double phi = 2 * kPi * (columns.first + columns.step * j) / columns.turn;
        const long double left = 2 * kPi * j / width, right = 2 * kPi * (j + 1) / width;
        const long double cosine = (std::sin(m * right) - std::sin(m * left)) / m;
        const long double sine = (std::cos(m * left) - std::cos(m * right)) / m;
        EXPECT_NEAR(weights.azimuth[m] * static_cast<double>(std::cos(m * phi)),
                    static_cast<double>(cosine), 1e-15);
        EXPECT_NEAR(weights.azimuth[m] * static_cast<double>(std::sin(m * phi)),
                    static_cast<double>(sine), 1e-15);
      }
      if (m % width == 0) {
        EXPECT_EQ(weights.azimuth[m], 0.0) << "whole waves";
      }
    }
  }
}

// A constant picture: every even zonal sum over the rows vanishes but that of l = 0, for any
// height.
TEST(TexelWeights, ConstantPictureHasNoHigherDegree) {
  for (int height : {1, 2, 9, 64, 511, 2048}) {
    const ProjectionWeights weights =
        make_projection_weights(grid_of(height), Quadrature::texel, kMaxDegree);
    for (int l = 2; l <= kMaxDegree; l += 2) {
      double sum = 0.0;
      for (int i = 0; i < height; ++i) sum += polar(weights, l, 0, i);
      EXPECT_NEAR(sum, 0.0, 1e-14) << height << ' ' << l;
    }
  }
}

// A whole pixel, two-dimensional: the picture that is 1 in one pixel projects to the integral of
// Y_lm over that pixel's area.
TEST(TexelWeights, OnePixelProjectsToItsArea) {
  constexpr int kDegree = 8, kWidth = 6, kHeight = 5;
  const ProjectionWeights weights =
      make_projection_weights({kWidth, kHeight}, Quadrature::texel, kDegree);
  const ColumnAngles columns = column_angles(weights.grid);
  const Basis<double> basis(kDegree);
  const GaussRule rule = gauss_legendre(24);
  std::vector<double> y(coefficient_count(kDegree));
  for (const auto& [row, column] : {std::pair{0, 0}, {1, 5}, {2, 3}, {4, 2}}) {
    std::vector<double> expected(y.size());
    for (std::size_t a = 0; a < rule.nodes.size(); ++a) {
      for (std::size_t b = 0; b < rule.nodes.size(); ++b) {
        const double theta = static_cast<double>(kPi * (row + (rule.nodes[a] + 1) / 2) / kHeight);
        const double phi =
            static_cast<double>(2 * kPi * (column + (rule.nodes[b] + 1) / 2) / kWidth);
        const double s = std::sin(theta);
        const double area = static_cast<double>(rule.weights[a] * rule.weights[b] * kPi / kHeight /
                                                2 * kPi / kWidth) *
                            s;
        basis.evaluate({s * std::cos(phi), s * std::sin(phi), std::cos(theta)}, y);
        for (std::size_t i = 0; i < y.size(); ++i) expected[i] += area * y[i];
      }
    }
    const double phi =
        static_cast<double>(2 * kPi * (columns.first + columns.step * column) / columns.turn);
    for (int l = 0; l <= kDegree; ++l) {
      for (int m = -l; m <= l; ++m) {
        const int k = std::abs(m);
        const double wave = m >= 0 ? std::cos(k * phi) : std::sin(k * phi);
        EXPECT_NEAR(weights.azimuth[k] * polar(weights, l, k, row) * wave,
                    expected[coefficient_index(l, m)], 1e-14)
            << l << ' ' << m << " row " << row;
      }
    }
  }
}

// Largest error of sum_i polar(l, m, i) Pbar_l'm(theta_i) against 1/(2 pi) (1/pi for m > 0) or 0,
// over all pairs with l + l' = total.
double gram_error(const ProjectionWeights& weights, int total) {
  const int degree = weights.degree;
  const AssociatedLegendre<double> legendre(degree);
  std::vector<std::vector<double>> p;
  for (int i = 0; i < weights.grid.height; ++i) {
    const PolarAngle angle = row_angle(weights.grid, i);
    p.emplace_back(legendre_count(degree));
    legendre.evaluate(static_cast<double>(angle.cos_theta), static_cast<double>(angle.sin_theta),
                      p.back());
  }
  double worst = 0.0;
  for (int l = std::max(0, total - degree); l <= std::min(degree, total); ++l) {
    const int k = total - l;
    for (int m = 0; m <= std::min(l, k); ++m) {
      double sum = 0.0;
      for (int i = 0; i < weights.grid.height; ++i) {
        sum += polar(weights, l, m, i) * p[i][legendre_index(k, m)];
      }
      const double exact = l == k ? (m == 0 ? 0.5 : 1.0) / std::numbers::pi : 0.0;
      worst = std::max(worst, std::abs(sum - exact));
    }
  }
  return worst;
}

// Exact while l + l' <= H-1, and no further: the next even total fails (an odd one vanishes by
// symmetry).
void expect_exact_to_its_degree(Quadrature quadrature, Sampling sampling, int height) {
  const int degree = std::min(height, kMaxDegree);
  const ProjectionWeights weights =
      make_projection_weights(grid_of(height, sampling), quadrature, degree);
  for (int total = 0; total <= std::min(height - 1, 2 * degree); ++total) {
    EXPECT_LT(gram_error(weights, total), 5e-14) << "height " << height << " total " << total;
  }
  const int beyond = height % 2 == 0 ? height : height + 1;
  // It falls with the height like the error of the rule at its first wrong degree, 1/H^2 or 1/H^3.
  EXPECT_GT(gram_error(weights, beyond), 1e-6) << "height " << height;
}

TEST(Fejer, IsExactForBandLimitedSamples) {
  for (int height : {2, 3, 4, 11, 16, 33, 64, 65, 100}) {
    expect_exact_to_its_degree(Quadrature::fejer, Sampling::centers, height);
  }
}

TEST(ClenshawCurtis, IsExactForBandLimitedSamples) {
  for (int height : {2, 3, 4, 11, 16, 33, 64, 65, 100}) {
    expect_exact_to_its_degree(Quadrature::clenshaw_curtis, Sampling::endpoints, height);
  }
}

// Columns: sums of cos(m phi_j) cos(m' phi_j) are exact while m + m' < the number of distinct
// columns, so that W >= 2L+1 serves degree L; at endpoints one column more, since two are the same.
TEST(Quadrature, ColumnSumsAreExactToTheirOrder) {
  constexpr int kDegree = 8;
  for (const EquirectGrid& grid : {EquirectGrid{2 * kDegree + 1, 4, Sampling::centers},
                                   EquirectGrid{2 * kDegree + 2, 4, Sampling::endpoints}}) {
    const ColumnAngles columns = column_angles(grid);
    const ProjectionWeights weights = make_projection_weights(grid, Quadrature::fejer, kDegree);
    for (int m = 0; m <= kDegree; ++m) {
      for (int k = 0; k <= kDegree; ++k) {
        double cosines = 0.0, mixed = 0.0;
        for (int j = 0; j < grid.width; ++j) {
          const bool edge = j == 0 || j == grid.width - 1;
          const double w = weights.azimuth[m] * (edge ? columns.edge_weight : 1.0);
          const double phi =
              static_cast<double>(2 * kPi * (columns.first + columns.step * j) / columns.turn);
          cosines += w * std::cos(m * phi) * std::cos(k * phi);
          mixed += w * std::cos(m * phi) * std::sin(k * phi);
        }
        const double expected = m != k ? 0.0 : std::numbers::pi * (m == 0 ? 2 : 1);
        EXPECT_NEAR(cosines, expected, 1e-13) << m << ' ' << k;
        EXPECT_NEAR(mixed, 0.0, 1e-13) << m << ' ' << k;
      }
    }
  }
}

TEST(Quadrature, EquatorRowIsExactlyEven) {
  for (Quadrature quadrature : {Quadrature::texel, Quadrature::midpoint, Quadrature::fejer}) {
    for (Sampling sampling : {Sampling::centers, Sampling::endpoints}) {
      const ProjectionWeights weights =
          make_projection_weights(grid_of(33, sampling), quadrature, kMaxDegree);
      ASSERT_EQ(weights.northern_rows, 17);
      for (int l = 0; l <= kMaxDegree; ++l) {
        for (int m = (l + 1) % 2; m <= l; m += 2) {
          EXPECT_EQ(polar(weights, l, m, 16), 0.0) << l << ' ' << m;
        }
      }
    }
  }
}

TEST(Quadrature, EndpointsStandOnThePoles) {
  const EquirectGrid grid = grid_of(9, Sampling::endpoints);
  const PolarAngle north = row_angle(grid, 0), south = row_angle(grid, 8),
                   equator = row_angle(grid, 4);
  EXPECT_EQ(north.cos_theta, 1.0L);
  EXPECT_EQ(north.sin_theta, 0.0L);
  EXPECT_EQ(south.cos_theta, -1.0L);
  EXPECT_EQ(south.sin_theta, 0.0L);
  EXPECT_EQ(equator.cos_theta, 0.0L);
  EXPECT_EQ(equator.sin_theta, 1.0L);
  const ColumnAngles columns = column_angles(grid);
  EXPECT_EQ(columns.first, 0);
  EXPECT_EQ(columns.step * (grid.width - 1), columns.turn);  // the last column is the first again
  EXPECT_EQ(columns.edge_weight, 0.5);
  const ProjectionWeights weights = make_projection_weights(grid, Quadrature::texel, 4);
  EXPECT_EQ(weights.quadrature, Quadrature::clenshaw_curtis);
  for (int l = 1; l <= 4; ++l) {
    for (int m = 1; m <= l; ++m) EXPECT_EQ(polar(weights, l, m, 0), 0.0);
  }
}

TEST(Quadrature, RowsAreMirroredExactly) {
  for (Sampling sampling : {Sampling::centers, Sampling::endpoints}) {
    for (int height : {2, 7, 512}) {
      const EquirectGrid grid = grid_of(height, sampling);
      for (int i = 0; i < height; ++i) {
        const PolarAngle north = row_angle(grid, i), south = row_angle(grid, height - 1 - i);
        EXPECT_EQ(north.cos_theta, -south.cos_theta);
        EXPECT_EQ(north.sin_theta, south.sin_theta);
        EXPECT_NEAR(static_cast<double>(std::atan2(north.sin_theta, north.cos_theta)),
                    static_cast<double>(sampling == Sampling::centers ? kPi * (i + 0.5L) / height
                                                                      : kPi * i / (height - 1)),
                    1e-15);
      }
    }
  }
}

TEST(Quadrature, WhatIsUsedOnWhichSampling) {
  for (Quadrature asked : {Quadrature::texel, Quadrature::midpoint, Quadrature::fejer}) {
    EXPECT_EQ(effective_quadrature(asked, Sampling::centers), asked);
    EXPECT_EQ(effective_quadrature(asked, Sampling::endpoints), Quadrature::clenshaw_curtis);
  }
  EXPECT_EQ(effective_quadrature(Quadrature::clenshaw_curtis, Sampling::centers),
            Quadrature::fejer);
}

TEST(Quadrature, NamesReadBack) {
  for (Quadrature q :
       {Quadrature::texel, Quadrature::midpoint, Quadrature::fejer, Quadrature::clenshaw_curtis}) {
    ASSERT_TRUE(parse_quadrature(name_of(q)).ok());
    EXPECT_EQ(*parse_quadrature(name_of(q)), q);
  }
  EXPECT_EQ(parse_quadrature("texl").error().hint, "did you mean \"texel\"?");
  EXPECT_EQ(parse_quadrature("monte-carlo").error().hint, "use texel, midpoint or fejer");
}

}  // namespace
}  // namespace shoal
