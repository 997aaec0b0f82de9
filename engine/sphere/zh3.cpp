#include "sphere/zh3.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

#include "sphere/basis.h"
#include "sphere/linear_operations.h"

namespace shoal {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr int kQuadraticBegin = 4;  // indices of degree 2
constexpr int kQuadraticEnd = 9;

glm::dvec3 linear_vector(const Coefficients& radiance, int channel) {
  const auto& c = radiance.channels[channel];
  return {c[coefficient_index(1, 1)], c[coefficient_index(1, -1)], c[coefficient_index(1, 0)]};
}

// Everything but the quadratic coefficients.
QuadraticZonal linear_part(const Coefficients& radiance) {
  QuadraticZonal light;
  light.linear = truncate(radiance, 1);
  const glm::dvec3 vector(luminance(radiance, coefficient_index(1, 1)),
                          luminance(radiance, coefficient_index(1, -1)),
                          luminance(radiance, coefficient_index(1, 0)));
  if (glm::length(vector) > 0.0) light.axis = glm::normalize(vector);
  return light;
}

// Y_2m(axis) sqrt(4 pi/5): the coefficients of Z, which is Y_20 turned to the axis. Their squares
// sum to 1.
std::vector<double> zonal_coefficients(const glm::dvec3& axis) {
  std::vector<double> y(kQuadraticEnd);
  Basis<double>(2).evaluate(axis, y);
  for (double& value : y) value *= std::sqrt(4 * kPi / 5);
  return y;
}

}  // namespace

QuadraticZonal fit_zh3(const Coefficients& radiance) {
  QuadraticZonal light = linear_part(radiance);
  const std::vector<double> zonal = zonal_coefficients(light.axis);
  for (int c = 0; c < kChannelCount; ++c) {
    for (int i = kQuadraticBegin; i < kQuadraticEnd; ++i) {
      light.quadratic[c] += radiance.channels[c][i] * zonal[i];
    }
  }
  return light;
}

QuadraticZonal hallucinate_zh3(const Coefficients& radiance) {
  QuadraticZonal light = linear_part(radiance);
  for (int c = 0; c < kChannelCount; ++c) {
    const double mean = radiance.channels[c][0];
    if (!(mean > 0.0)) continue;
    const double ratio = std::abs(glm::dot(linear_vector(radiance, c), light.axis)) / mean;
    light.quadratic[c] = mean * ratio * (0.08 + 0.6 * ratio);
  }
  return light;
}

Coefficients expand(const QuadraticZonal& light) {
  Coefficients radiance(2);
  const std::vector<double> zonal = zonal_coefficients(light.axis);
  for (int c = 0; c < kChannelCount; ++c) {
    std::copy(light.linear.channels[c].begin(), light.linear.channels[c].end(),
              radiance.channels[c].begin());
    for (int i = kQuadraticBegin; i < kQuadraticEnd; ++i) {
      radiance.channels[c][i] = light.quadratic[c] * zonal[i];
    }
  }
  return radiance;
}

glm::dvec3 nonlinear_irradiance(const Coefficients& radiance, const glm::dvec3& direction) {
  glm::dvec3 irradiance(0.0);
  for (int c = 0; c < kChannelCount; ++c) {
    const double mean = radiance.channels[c][0] / std::sqrt(4 * kPi);
    if (!(mean > 0.0)) continue;
    const glm::dvec3 vector = linear_vector(radiance, c) / std::sqrt(12 * kPi);
    const double length = glm::length(vector);
    const double r = std::min(1.0, length / mean);
    const double cosine = length > 0.0 ? glm::dot(vector, direction) / length : 0.0;
    const double t = std::clamp((1.0 + cosine) / 2, 0.0, 1.0);
    const double power = 1.0 + 2.0 * r;
    const double even = (1.0 - r) / (1.0 + r);
    const double lobe = static_cast<double>(std::pow(static_cast<long double>(t), power));
    irradiance[c] = kPi * mean * (even + (1.0 - even) * (power + 1.0) * lobe);
  }
  return irradiance;
}

}  // namespace shoal
