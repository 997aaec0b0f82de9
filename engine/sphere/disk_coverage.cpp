#include "sphere/disk_coverage.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "sphere/gauss_legendre.h"

namespace shoal {
namespace {

constexpr double kPi = std::numbers::pi;

// Where w begins and ends it goes like a square root, which t = middle + half sin(u) makes smooth.
constexpr int kNodes = 24;

// Halvings of an interval: to a double's last place.
constexpr int kBisections = 53;

double squared_sine(double x) { return std::sin(x) * std::sin(x); }

struct Rule {
  std::array<double, kNodes> nodes{};
  std::array<double, kNodes> weights{};

  Rule() {
    const GaussRule exact = gauss_legendre(kNodes);
    std::ranges::copy(exact.nodes, nodes.begin());
    std::ranges::copy(exact.weights, weights.begin());
  }
};

const Rule& rule() {
  static const Rule nodes;
  return nodes;
}

}  // namespace

DiskCoverage::DiskCoverage(const DiskLight& disk, int width, int height)
    : width_(width), height_(height), is_complement_(disk.angular_radius > kPi / 2) {
  const glm::dvec3 axis = (is_complement_ ? -1.0 : 1.0) * disk.direction;
  theta_ = std::atan2(std::hypot(axis.x, axis.y), axis.z);
  phi_ = std::atan2(axis.y, axis.x);
  if (phi_ < 0.0) phi_ += 2.0 * kPi;
  radius_ = is_complement_ ? kPi - disk.angular_radius : disk.angular_radius;
  begin_ = std::max(-radius_, radius_ - 2.0 * theta_);
  end_ = std::min(radius_, 2.0 * (kPi - theta_) - radius_);
  if (radius_ > theta_) {
    peak_ = begin_;
  } else if (radius_ > kPi - theta_) {
    peak_ = end_;
  } else {
    // In the right triangle of pole, axis and the point where a meridian touches the disk,
    // cos(theta_0) = cos(r) cos(theta).
    const double sines = std::sin(theta_ - radius_) * std::sin(theta_ + radius_);
    const double touching = std::atan2(std::sqrt(std::max(0.0, sines)), std::cos(theta_));
    peak_ = std::clamp(touching - theta_, begin_, end_);
  }
}

std::vector<double> DiskCoverage::shares(int row) const {
  std::vector<double> covered = shares_of_small(row);
  if (!is_complement_) return covered;
  covered.resize(width_, 0.0);
  for (double& share : covered) share = 1.0 - share;
  return covered;
}

std::vector<double> DiskCoverage::shares_of_small(int row) const {
  const Slice slice = slice_of(row);
  if (slice.begin >= slice.end && slice.ring == 0.0) return {};
  const double step = 2.0 * kPi / width_;
  const double top = kPi / height_ * row - theta_;
  const double texel = step * zone(top, kPi / height_ * (row + 1) - theta_);
  std::vector<double> covered(width_);
  double before = within_signed(-phi_, slice);
  for (int column = 0; column < width_; ++column) {
    const double after = within_signed(step * (column + 1) - phi_, slice);
    covered[column] = std::clamp((after - before) / texel, 0.0, 1.0);
    before = after;
  }
  return covered;
}

DiskCoverage::Slice DiskCoverage::slice_of(int row) const {
  const double top = kPi / height_ * row - theta_;
  const double bottom = kPi / height_ * (row + 1) - theta_;
  Slice slice;
  if (radius_ > theta_ && top < begin_) slice.ring = zone(top, std::min(bottom, begin_));
  if (radius_ > kPi - theta_ && bottom > end_) slice.ring += zone(std::max(top, end_), bottom);
  slice.begin = std::max(top, begin_);
  slice.end = std::min(bottom, end_);
  if (slice.begin >= slice.end) return slice;
  slice.least = std::min(half_width(slice.begin), half_width(slice.end));
  slice.most = half_width(std::clamp(peak_, slice.begin, slice.end));
  slice.whole = integral_of_width(slice.begin, slice.end);
  return slice;
}

double DiskCoverage::half_sine_squared(double t) const {
  const double below = std::sin(theta_ + t) * std::sin(theta_);
  const double above = std::sin((radius_ + t) / 2) * std::sin((radius_ - t) / 2);
  return below > 0.0 ? std::clamp(above / below, 0.0, 1.0) : 1.0;
}

double DiskCoverage::half_width(double t) const {
  return 2.0 * std::asin(std::sqrt(half_sine_squared(t)));
}

// The integral of sin(theta), without loss where the zone is narrow.
double DiskCoverage::zone(double begin, double end) const {
  return 2.0 * std::sin(theta_ + (begin + end) / 2) * std::sin((end - begin) / 2);
}

double DiskCoverage::integral_of_width(double begin, double end) const {
  const double middle = (begin_ + end_) / 2;
  const double half = (end_ - begin_) / 2;
  const double from = std::asin(std::clamp((begin - middle) / half, -1.0, 1.0));
  const double to = std::asin(std::clamp((end - middle) / half, -1.0, 1.0));
  double sum = 0.0;
  for (int i = 0; i < kNodes; ++i) {
    const double u = (from + to) / 2 + (to - from) / 2 * rule().nodes[i];
    const double t = middle + half * std::sin(u);
    sum += rule().weights[i] * half * std::cos(u) * half_width(t) * std::sin(theta_ + t);
  }
  return (to - from) / 2 * sum;
}

// Where w passes x on the way from `low`, where it is less, to `high`.
double DiskCoverage::crossing(double x, double low, double high) const {
  const double wanted = squared_sine(x / 2);
  for (int i = 0; i < kBisections; ++i) {
    const double middle = (low + high) / 2;
    (half_sine_squared(middle) < wanted ? low : high) = middle;
  }
  return high;
}

// G(x) for 0 <= x <= pi.
double DiskCoverage::within(double x, const Slice& slice) const {
  const double ring = x * slice.ring;
  if (x >= slice.most) return ring + slice.whole;
  if (x <= slice.least) return ring + x * zone(slice.begin, slice.end);
  const double peak = std::clamp(peak_, slice.begin, slice.end);
  const double rises = half_width(slice.begin) < x ? crossing(x, slice.begin, peak) : slice.begin;
  const double falls = half_width(slice.end) < x ? crossing(x, slice.end, peak) : slice.end;
  double sum = ring + x * zone(rises, falls);
  if (rises > slice.begin) sum += integral_of_width(slice.begin, rises);
  if (falls < slice.end) sum += integral_of_width(falls, slice.end);
  return sum;
}

// The same from -2 pi to 2 pi: odd, and once around is twice G(pi).
double DiskCoverage::within_signed(double x, const Slice& slice) const {
  const double angle = std::abs(x);
  const double around =
      angle <= kPi ? within(angle, slice)
                   : 2.0 * within(kPi, slice) - within(std::max(0.0, 2.0 * kPi - angle), slice);
  return std::copysign(around, x);
}

}  // namespace shoal
