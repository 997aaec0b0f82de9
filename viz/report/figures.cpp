#include "report/figures.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <numbers>
#include <vector>

#include "library/light.h"
#include "sphere/irradiance.h"
#include "sphere/legendre.h"
#include "sphere/linear_operations.h"

namespace shoal::viz {
namespace {

constexpr double kDegreesPerRadian = 180.0 / std::numbers::pi;

std::vector<double> luminance_of(const Coefficients& coefficients) {
  std::vector<double> values;
  for (int i = 0; i < coefficient_count(coefficients.degree); ++i) {
    values.push_back(luminance(coefficients, i));
  }
  return values;
}

// Calls take(value, weight) for every direction of the grid, weight the share of the sphere.
template <typename Take>
void for_each_direction(const std::vector<double>& channel, int degree, const Take& take) {
  constexpr int kColumns = 2 * kFigureRows;
  const AssociatedLegendre<double> legendre(degree);
  std::vector<double> pbar(legendre_count(degree));
  std::vector<double> cosine(degree + 1), sine(degree + 1);
  for (int row = 0; row < kFigureRows; ++row) {
    const double theta = std::numbers::pi * (row + 0.5) / kFigureRows;
    const double top = std::numbers::pi * row / kFigureRows;
    const double bottom = std::numbers::pi * (row + 1) / kFigureRows;
    const double weight = (std::cos(top) - std::cos(bottom)) / (2.0 * kColumns);
    legendre.evaluate(std::cos(theta), std::sin(theta), pbar);
    for (int m = 0; m <= degree; ++m) {
      cosine[m] = sine[m] = 0.0;
      for (int l = m; l <= degree; ++l) {
        cosine[m] += pbar[legendre_index(l, m)] * channel[coefficient_index(l, m)];
        sine[m] += pbar[legendre_index(l, m)] * channel[coefficient_index(l, -m)];
      }
    }
    for (int column = 0; column < kColumns; ++column) {
      const double phi = 2.0 * std::numbers::pi * (column + 0.5) / kColumns;
      double value = cosine[0];
      for (int m = 1; m <= degree; ++m) {
        value += cosine[m] * std::cos(m * phi) + sine[m] * std::sin(m * phi);
      }
      take(value, weight);
    }
  }
}

void add_irradiance_figures(const Coefficients& radiance, LightFigures& figures) {
  const Coefficients irradiance = apply_quantity(radiance, Quantity::irradiance);
  figures.minimum_irradiance = std::numeric_limits<double>::infinity();
  figures.maximum_irradiance = -std::numeric_limits<double>::infinity();
  for_each_direction(luminance_of(irradiance), irradiance.degree, [&](double value, double weight) {
    figures.minimum_irradiance = std::min(figures.minimum_irradiance, value);
    figures.maximum_irradiance = std::max(figures.maximum_irradiance, value);
    if (value < 0.0) figures.negative_fraction += weight;
  });
  const double sum = figures.maximum_irradiance + figures.minimum_irradiance;
  if (sum > 0.0) {
    figures.contrast = (figures.maximum_irradiance - figures.minimum_irradiance) / sum;
  }
}

}  // namespace

LightFigures light_figures(const Coefficients& radiance) {
  LightFigures figures;
  figures.mean = mean_of(radiance);
  figures.mean_luminance = luminance(figures.mean);
  add_irradiance_figures(radiance, figures);
  figures.dominance = dominance_of(radiance);
  const glm::dvec3 vector = dominant_vector(radiance);
  const double length = glm::length(vector);
  if (length > 0.0) figures.direction = vector / length;
  return figures;
}

double elevation_of(const glm::dvec3& native) {
  return kDegreesPerRadian * std::asin(std::clamp(native.z, -1.0, 1.0));
}

// The picture's centre is -x, a quarter turn to its right -y (sphere/conventions.h).
double azimuth_of(const glm::dvec3& native) {
  return kDegreesPerRadian * std::atan2(-native.y, -native.x);
}

}  // namespace shoal::viz
