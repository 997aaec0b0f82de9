#include "sphere/disk_coverage.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>
#include <numeric>

namespace shoal {
namespace {

constexpr double kPi = std::numbers::pi;

DiskLight disk_at(double theta, double phi, double radius) {
  const double sine = std::sin(theta);
  return {{sine * std::cos(phi), sine * std::sin(phi), std::cos(theta)}, radius, glm::dvec3(1.0)};
}

double texel_solid_angle(int row, int width, int height) {
  return 2.0 * kPi / width * 2.0 * std::sin(kPi * (row + 0.5) / height) *
         std::sin(kPi / (2 * height));
}

double covered(const DiskLight& disk, int width, int height) {
  const DiskCoverage coverage(disk, width, height);
  double sum = 0.0;
  for (int row = 0; row < height; ++row) {
    for (const double share : coverage.shares(row)) {
      EXPECT_GE(share, 0.0);
      EXPECT_LE(share, 1.0);
      sum += share * texel_solid_angle(row, width, height);
    }
  }
  return sum;
}

// 4 pi sin^2(r/2), whatever the grid and wherever the disk lies: over a pole, beside it, touching
// it, across the seam; a millionth of a texel, several texels, nearly all of the sphere.
TEST(DiskCoverage, SumsToTheSolidAngle) {
  for (const double radius : {1e-6, 1e-3, 0.01, 0.3, 1.0, kPi / 2, 2.0, 3.1, kPi}) {
    for (const double theta : {0.0, 1e-7, 0.3 * radius, radius, 1.001 * radius, 0.7, kPi / 2, 2.9,
                               kPi - 0.5 * radius, kPi}) {
      if (theta > kPi) continue;
      for (const double phi : {0.0, 1e-4, 3.0, -kPi / 2}) {
        for (const auto& [width, height] : {std::pair(16, 8), {7, 5}, {1, 1}, {90, 45}}) {
          const double exact = 4.0 * kPi * std::pow(std::sin(radius / 2), 2);
          EXPECT_NEAR(covered(disk_at(theta, phi, radius), width, height), exact, 1e-9 * exact)
              << "r " << radius << " theta " << theta << " phi " << phi << " width " << width;
        }
      }
    }
  }
}

// Against points that are within or not, 150 x 150 a texel: a row of them tells each of the two
// places where it crosses the edge to half a point.
TEST(DiskCoverage, IsTheShareOfThePointsWithin) {
  constexpr int kWidth = 12, kHeight = 6, kPoints = 150;
  for (const DiskLight& disk :
       {disk_at(1.1, 6.2, 0.4), disk_at(0.2, 2.0, 0.5), disk_at(2.8, 1.0, 0.2),
        disk_at(1.5, 3.0, 0.1), disk_at(0.9, -2.0, 2.2), disk_at(0.0, 0.0, 0.8)}) {
    const DiskCoverage coverage(disk, kWidth, kHeight);
    for (int row = 0; row < kHeight; ++row) {
      std::vector<double> shares = coverage.shares(row);
      shares.resize(kWidth, 0.0);
      for (int column = 0; column < kWidth; ++column) {
        double within = 0.0, all = 0.0;
        for (int i = 0; i < kPoints; ++i) {
          const double theta = kPi / kHeight * (row + (i + 0.5) / kPoints);
          for (int j = 0; j < kPoints; ++j) {
            const double phi = 2 * kPi / kWidth * (column + (j + 0.5) / kPoints);
            const glm::dvec3 w = disk_at(theta, phi, 1.0).direction;
            all += std::sin(theta);
            if (glm::dot(w, disk.direction) > std::cos(disk.angular_radius)) {
              within += std::sin(theta);
            }
          }
        }
        EXPECT_NEAR(shares[column], within / all, 1.0 / kPoints) << row << " " << column;
      }
    }
  }
}

// About a pole every texel of a row has the same share: 0, 1, or of the row that the edge crosses
// what the zones say.
TEST(DiskCoverage, OfACapIsTheShareOfTheZone) {
  constexpr int kHeight = 9;
  const double radius = 0.8;
  const DiskCoverage coverage(disk_at(0.0, 0.0, radius), 18, kHeight);
  for (int row = 0; row < kHeight; ++row) {
    const double top = kPi * row / kHeight, bottom = kPi * (row + 1) / kHeight;
    const double end = std::clamp(radius, top, bottom);
    const double expected = (std::cos(top) - std::cos(end)) / (std::cos(top) - std::cos(bottom));
    for (const double share : coverage.shares(row)) EXPECT_NEAR(share, expected, 1e-13) << row;
  }
}

// A row that no disk reaches has none, so that small disks cost little.
TEST(DiskCoverage, LeavesOtherRowsAlone) {
  const DiskCoverage coverage(disk_at(0.5, 0.0, 0.01), 200, 100);
  for (int row = 0; row < 100; ++row) {
    const bool is_reached = kPi * row / 100 < 0.51 && kPi * (row + 1) / 100 > 0.49;
    EXPECT_EQ(coverage.shares(row).empty(), !is_reached) << row;
  }
}

}  // namespace
}  // namespace shoal
