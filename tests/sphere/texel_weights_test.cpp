#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

#include "quadrature_samples.h"
#include "sphere/basis.h"
#include "sphere/coefficients.h"
#include "sphere/gauss_legendre.h"
#include "sphere/legendre.h"

namespace shoal {
namespace {

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

}  // namespace
}  // namespace shoal
