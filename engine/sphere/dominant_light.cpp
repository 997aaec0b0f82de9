#include "sphere/dominant_light.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

#include "sphere/basis.h"
#include "sphere/linear_operations.h"

namespace shoal {
namespace {

// Below this part of L_00 a degree-1 vector is what rounding leaves of an even light.
constexpr double kLeastVector = 1e-12;

// e that minimises sum (L_lm - e y_lm)^2 over l <= degree, held at 0.
glm::dvec3 least_squares_irradiance(const Coefficients& radiance, std::span<const double> y,
                                    int degree) {
  const double norm = coefficient_count(degree) / (4 * std::numbers::pi);
  glm::dvec3 irradiance(0.0);
  for (int c = 0; c < kChannelCount; ++c) {
    for (int i = 0; i < coefficient_count(degree); ++i) {
      irradiance[c] += radiance.channels[c][i] * y[i];
    }
    irradiance[c] = std::max(0.0, irradiance[c] / norm);
  }
  return irradiance;
}

double energy(const Coefficients& coefficients, int degree) {
  double sum = 0.0;
  for (const auto& channel : coefficients.channels) {
    for (int i = 0; i < coefficient_count(degree); ++i) sum += channel[i] * channel[i];
  }
  return sum;
}

}  // namespace

std::optional<DominantLight> dominant_light(const Coefficients& radiance) {
  if (radiance.degree < 1) return std::nullopt;
  const glm::dvec3 vector(luminance(radiance, coefficient_index(1, 1)),
                          luminance(radiance, coefficient_index(1, -1)),
                          luminance(radiance, coefficient_index(1, 0)));
  const double length = glm::length(vector);
  const double mean = luminance(radiance, 0);
  // Written so that what is not a number has no direction either.
  if (!(length > kLeastVector * std::abs(mean)) || !std::isfinite(length)) return std::nullopt;

  DominantLight found;
  found.light.direction = glm::normalize(vector / length);
  std::vector<double> y(coefficient_count(radiance.degree));
  Basis<double>(radiance.degree).evaluate(found.light.direction, y);
  const int degree = std::min(kDominantFitDegree, radiance.degree);
  found.light.irradiance = least_squares_irradiance(radiance, y, degree);

  found.projected = Coefficients(radiance.degree);
  found.residual = Coefficients(radiance.degree);
  for (int c = 0; c < kChannelCount; ++c) {
    for (int i = 0; i < coefficient_count(radiance.degree); ++i) {
      const double whole = radiance.channels[c][i];
      const double light = found.light.irradiance[c] * y[i];
      const double rest = whole - light;
      // Where |light| <= |whole|, whole - rest is exact (Dekker, "A floating-point technique for
      // extending the available precision", Numer. Math. 18 (1971), theorem 4.7), so that the two
      // parts sum to the whole exactly, and rounding gives it back.
      found.residual.channels[c][i] = rest;
      found.projected.channels[c][i] = whole - rest;
    }
  }
  // Y_1m of a direction has length sqrt(3/(4 pi)), Y_00 is sqrt(1/(4 pi)).
  found.directionality = length / (std::sqrt(3.0) * mean);
  found.energy_share = 1.0 - energy(found.residual, degree) / energy(radiance, degree);
  return found;
}

}  // namespace shoal
