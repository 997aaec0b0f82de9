// How much of each texel of an equirect picture a disk covers.
#pragma once

#include <vector>

#include "sphere/analytic_lights.h"

namespace shoal {

// With theta_0 the polar angle of the disk's axis and r its radius, the disk holds at theta those
// azimuths that are at most w(theta) from the axis's:
//   sin^2(w/2) = sin((r+t)/2) sin((r-t)/2) / (sin theta sin theta_0),   t = theta - theta_0,
// by the haversine formula, which loses nothing where the disk is small. So of the azimuths 0 to x
// it covers in a row of texels
//   G(x) = integral of min(x, w(theta)) sin(theta) dtheta,
// and a texel's share is the difference of G at its two sides. What the texels of a row sum to is
// G(pi) whatever the columns, and what the rows sum to is the disk's solid angle.
//
// Accuracy: 1e-9 of the disk's solid angle wherever it lies, for radii of 1e-6 and more; of smaller
// ones near a pole 1e-15 over the radius. A disk greater than a hemisphere is the sphere without
// its opposite.
class DiskCoverage {
 public:
  // Preconditions: check_light; width, height >= 1.
  DiskCoverage(const DiskLight& disk, int width, int height);

  // The share of each texel of a row that is covered, in [0, 1]; nothing at all where none is.
  [[nodiscard]] std::vector<double> shares(int row) const;

 private:
  // What the disk covers of a row, but for a ring that is covered all round. Angles are t.
  struct Slice {
    double begin = 0.0;
    double end = 0.0;
    double least = 0.0;  // w
    double most = 0.0;
    double whole = 0.0;  // the integral of w sin(theta)
    double ring = 0.0;   // sr a radian of azimuth
  };

  [[nodiscard]] std::vector<double> shares_of_small(int row) const;
  [[nodiscard]] Slice slice_of(int row) const;
  [[nodiscard]] double half_sine_squared(double t) const;  // sin^2(w/2)
  [[nodiscard]] double half_width(double t) const;         // w
  [[nodiscard]] double zone(double begin, double end) const;
  [[nodiscard]] double integral_of_width(double begin, double end) const;
  [[nodiscard]] double crossing(double x, double low, double high) const;
  [[nodiscard]] double within(double x, const Slice& slice) const;
  [[nodiscard]] double within_signed(double x, const Slice& slice) const;

  int width_;
  int height_;
  bool is_complement_;  // of the disk that is looked at, which is at most a hemisphere
  double theta_;
  double phi_;     // in [0, 2 pi)
  double radius_;  // at most pi/2
  double begin_;   // of the t at which w is between 0 and pi
  double end_;
  double peak_;  // where w is greatest; it rises before and falls behind
};

}  // namespace shoal
