#include "sphere/quadrature.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "quadrature_samples.h"
#include "sphere/conventions.h"
#include "sphere/legendre.h"

namespace shoal {
namespace {

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
