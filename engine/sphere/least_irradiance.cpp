#include "sphere/least_irradiance.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <numbers>
#include <string>

#include "sphere/irradiance.h"

namespace shoal {
namespace {

constexpr int kRowsPerDegree = 8;
// Candidates of a channel that are always refined.
constexpr int kDeepest = 12;
// Slopes are differences over this, over degree + 1: their error moves a minimum by 1e-6 of a wave,
// its value by 1e-12.
constexpr double kReach = 1e-3;
// A step that promises less, in units of the mean, is not worth taking.
constexpr double kLeastDescent = 1e-14;
constexpr std::string_view kChannelNames[kChannelCount] = {"red", "green", "blue"};

// How far a grid point next to a minimum may lie above it: h^2/2 times the greatest second
// derivative along a great circle, h = (pi / rows) / sqrt(2) being half a cell's diagonal. Degree l
// adds at most l^2 (Bernstein) times its greatest value, sqrt((2l+1)/(4 pi)) times its norm.
double grid_rise(const std::vector<double>& coefficients, int degree, int rows) {
  double curvature = 0.0;
  for (int l = 1; l <= degree; ++l) {
    double square = 0.0;
    for (int i = l * l; i < (l + 1) * (l + 1); ++i) square += coefficients[i] * coefficients[i];
    curvature += l * l * std::sqrt(square * (2 * l + 1) / (4 * std::numbers::pi));
  }
  const double cell = std::numbers::pi / rows;
  return cell * cell / 4 * curvature;
}

}  // namespace

// Two unit vectors at right angles to a direction and to each other.
struct IrradianceSearch::Tangents {
  glm::dvec3 direction, u, v;

  explicit Tangents(const glm::dvec3& at) : direction(at) {
    const glm::dvec3 off = std::abs(at.z) < 0.7 ? glm::dvec3(0, 0, 1) : glm::dvec3(1, 0, 0);
    u = glm::normalize(glm::cross(off, at));
    v = glm::cross(at, u);
  }
  [[nodiscard]] glm::dvec3 beside(double a, double b) const {
    return glm::normalize(direction + a * u + b * v);
  }
};

// Slope and curvature of a smooth function along two tangents.
struct IrradianceSearch::Quadratic {
  double du = 0.0, dv = 0.0;
  double duu = 0.0, duv = 0.0, dvv = 0.0;
};

IrradianceSearch::IrradianceSearch(int degree)
    : degree_(degree),
      grid_(degree, 2 * kRowsPerDegree * (degree + 1), kRowsPerDegree * (degree + 1)),
      basis_(degree) {}

Result<IrradianceSearch> IrradianceSearch::make(const Coefficients& radiance) {
  IrradianceSearch search(radiance.degree);
  const Coefficients irradiance = apply_quantity(radiance, Quantity::irradiance);
  for (int c = 0; c < kChannelCount; ++c) {
    const auto& channel = irradiance.channels[c];
    const bool finite =
        std::all_of(channel.begin(), channel.end(), [](double v) { return std::isfinite(v); });
    const bool dark = std::all_of(channel.begin(), channel.end(), [](double v) { return v == 0; });
    if (!finite) {
      return Error{ErrorCode::usage, "coefficients are not finite", "",
                   "a panorama with such pixels needs a policy for them"};
    }
    if (dark) continue;
    if (!(channel[0] > 0.0)) {
      return Error{ErrorCode::usage,
                   "the mean of the " + std::string(kChannelNames[c]) + " channel is not positive",
                   "", "no window can make irradiance non-negative where its mean is not"};
    }
    const double mean = channel[0] * std::sqrt(1 / (4 * std::numbers::pi));
    for (double value : channel) search.irradiance_[c].push_back(value / mean);
  }
  return search;
}

std::vector<double> IrradianceSearch::grid_values(const std::vector<double>& coefficients) const {
  const std::size_t columns = grid_.columns();
  std::vector<double> values(grid_.rows() * columns);
  for (int i = 0; i < grid_.rows(); ++i) {
    grid_.evaluate(coefficients, i, std::span(values).subspan(i * columns, columns));
  }
  return values;
}

bool IrradianceSearch::is_local_minimum(const std::vector<double>& values, int row,
                                        int column) const {
  const int rows = grid_.rows(), columns = grid_.columns();
  const double own = values[static_cast<std::size_t>(row) * columns + column];
  for (int i = row - 1; i <= row + 1; ++i) {
    for (int j = column - 1; j <= column + 1; ++j) {
      // Beyond a pole lies the same row, half a turn on.
      const bool beyond = i < 0 || i >= rows;
      const int neighbour_row = std::clamp(i, 0, rows - 1);
      const int neighbour = (j + columns + (beyond ? rows : 0)) % columns;
      if (values[static_cast<std::size_t>(neighbour_row) * columns + neighbour] < own) {
        return false;
      }
    }
  }
  return true;
}

std::vector<IrradianceSearch::Candidate> IrradianceSearch::candidates(
    const std::vector<double>& values, double rise) const {
  const double threshold = std::max(*std::min_element(values.begin(), values.end()), 0.0) + rise;
  std::vector<std::pair<double, int>> found;
  for (int i = 0; i < grid_.rows(); ++i) {
    for (int j = 0; j < grid_.columns(); ++j) {
      const int at = i * grid_.columns() + j;
      if (values[at] <= threshold && is_local_minimum(values, i, j)) {
        found.emplace_back(values[at], at);
      }
    }
  }
  std::sort(found.begin(), found.end());

  // One of those that lie within a quarter of the shortest wave of one another: around a pole, and
  // along the ring of least light that one lamp makes, rounding makes a minimum of every point.
  const double near = std::cos(std::numbers::pi / (2 * (degree_ + 1)));
  std::vector<Candidate> kept;
  for (const auto& [value, at] : found) {
    const glm::dvec3 direction = grid_.direction(at / grid_.columns(), at % grid_.columns());
    const bool taken = std::any_of(kept.begin(), kept.end(), [&](const Candidate& other) {
      return glm::dot(other.direction, direction) > near;
    });
    if (!taken) kept.push_back({value, direction});
  }
  return kept;
}

double IrradianceSearch::value_at(const std::vector<double>& coefficients,
                                  const glm::dvec3& direction) const {
  std::array<double, coefficient_count(kMaxDegree)> y;
  basis_.evaluate(direction, y);
  double sum = 0.0;
  for (int l = 0; l <= degree_; l += l < 2 ? 1 : 2) {  // odd degrees above 1 hold no irradiance
    for (int i = l * l; i < (l + 1) * (l + 1); ++i) sum += coefficients[i] * y[i];
  }
  return sum;
}

IrradianceSearch::Quadratic IrradianceSearch::quadratic_at(const std::vector<double>& coefficients,
                                                           double value, const Tangents& at) const {
  const double reach = kReach / (degree_ + 1);
  const auto beside = [&](double u, double v) { return value_at(coefficients, at.beside(u, v)); };
  const double east = beside(reach, 0), west = beside(-reach, 0);
  const double north = beside(0, reach), south = beside(0, -reach);
  const double diagonals =
      beside(reach, reach) + beside(-reach, -reach) - beside(reach, -reach) - beside(-reach, reach);
  const double area = reach * reach;
  return {(east - west) / (2 * reach), (north - south) / (2 * reach),
          (east - 2 * value + west) / area, diagonals / (4 * area),
          (north - 2 * value + south) / area};
}

// The way to the quadratic's minimum; where it has none, or nearly a line of them, its curvature is
// raised first (Levenberg's damping).
glm::dvec2 IrradianceSearch::newton_step(const Quadratic& q) {
  const double half_trace = (q.duu + q.dvv) / 2;
  const double spread = std::hypot((q.duu - q.dvv) / 2, q.duv);
  const double scale = std::abs(half_trace) + spread;
  if (scale == 0.0) return glm::dvec2(0.0);
  const double raise = std::max(0.0, spread - half_trace) + 1e-7 * scale;
  const double a = q.duu + raise, b = q.duv, d = q.dvv + raise;
  const double determinant = a * d - b * b;
  return {-(d * q.du - b * q.dv) / determinant, -(a * q.dv - b * q.du) / determinant};
}

LeastIrradiance IrradianceSearch::refine(const std::vector<double>& coefficients,
                                         glm::dvec3 direction) const {
  constexpr int kMostSteps = 50;
  constexpr int kMostHalvings = 6;
  const double longest = 0.5 / (degree_ + 1);
  double value = value_at(coefficients, direction);
  for (int step = 0; step < kMostSteps; ++step) {
    const Tangents tangents(direction);
    const Quadratic q = quadratic_at(coefficients, value, tangents);
    glm::dvec2 way = newton_step(q);
    if (-(q.du * way.x + q.dv * way.y) / 2 < kLeastDescent) break;
    if (const double length = glm::length(way); length > longest) way *= longest / length;

    glm::dvec3 next = tangents.beside(way.x, way.y);
    double next_value = value_at(coefficients, next);
    for (int halving = 0; halving < kMostHalvings && next_value >= value; ++halving) {
      way /= 2.0;
      next = tangents.beside(way.x, way.y);
      next_value = value_at(coefficients, next);
    }
    if (next_value >= value) break;
    direction = next;
    value = next_value;
  }
  return {value, direction, 0};
}

std::vector<LeastIrradiance> IrradianceSearch::minima(std::span<const double> gains,
                                                      Effort effort) const {
  std::vector<LeastIrradiance> found;
  for (int c = 0; c < kChannelCount; ++c) {
    std::vector<double> coefficients = irradiance_[c];
    if (coefficients.empty()) continue;
    for (int l = 0; l <= degree_; ++l) {
      for (int i = l * l; i < (l + 1) * (l + 1); ++i) coefficients[i] *= gains[l];
    }
    const double rise = grid_rise(coefficients, degree_, grid_.rows());
    double least = std::numeric_limits<double>::infinity();
    int refined = 0;
    for (const Candidate& candidate : candidates(grid_values(coefficients), rise)) {
      // They come with the least value first: nothing from here on can go below `least`.
      const bool certain = candidate.value - rise > least;
      if (refined >= kDeepest && (certain || effort == Effort::deepest)) break;
      found.push_back(refine(coefficients, candidate.direction));
      found.back().channel = c;
      least = std::min(least, found.back().value);
      ++refined;
    }
  }
  std::stable_sort(found.begin(), found.end(),
                   [](const auto& a, const auto& b) { return a.value < b.value; });
  return found;
}

std::vector<double> IrradianceSearch::parts(int channel, const glm::dvec3& direction) const {
  std::array<double, coefficient_count(kMaxDegree)> y;
  basis_.evaluate(direction, y);
  std::vector<double> sums(degree_ + 1, 0.0);
  for (int l = 0; l <= degree_; ++l) {
    for (int i = l * l; i < (l + 1) * (l + 1); ++i) sums[l] += irradiance_[channel][i] * y[i];
  }
  return sums;
}

Result<LeastIrradiance> least_irradiance(const Coefficients& radiance) {
  SHOAL_ASSIGN_OR_RETURN(search, IrradianceSearch::make(radiance));
  const std::vector<double> gains(radiance.degree + 1, 1.0);
  const std::vector<LeastIrradiance> minima =
      search.minima(gains, IrradianceSearch::Effort::certain);
  return minima.empty() ? LeastIrradiance{.value = 0.0} : minima.front();
}

}  // namespace shoal
