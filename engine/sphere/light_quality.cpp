#include "sphere/light_quality.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "sphere/colour_temperature.h"
#include "sphere/direction_grid.h"
#include "sphere/dominant_light.h"
#include "sphere/irradiance.h"
#include "sphere/linear_operations.h"
#include "sphere/negative_share.h"

namespace shoal {
namespace {

constexpr int kLeastRows = 64;
constexpr int kRowsPerDegree = 4;

glm::dvec3 mean_of(const Coefficients& radiance) {
  const auto& [r, g, b] = radiance.channels;
  return glm::dvec3(r[0], g[0], b[0]) / std::sqrt(4.0 * std::numbers::pi);
}

void add_irradiance_figures(const Coefficients& windowed, LightQuality& quality) {
  if (const auto least = least_irradiance(windowed)) quality.least = *least;
  const Coefficients irradiance = apply_quantity(windowed, Quantity::irradiance);
  std::vector<double> of_luminance;
  for (int i = 0; i < coefficient_count(irradiance.degree); ++i) {
    of_luminance.push_back(luminance(irradiance, i));
  }
  const int rows = std::max(kLeastRows, kRowsPerDegree * (irradiance.degree + 1));
  const EquirectValues grid = equirect_values(of_luminance, irradiance.degree, rows);
  const int degree = irradiance.degree;
  const double low = extremum_of(of_luminance, degree, grid, Extremum::least).value;
  const double high = extremum_of(of_luminance, degree, grid, Extremum::greatest).value;
  if (low < 0.0) quality.negative_fraction = negative_share(of_luminance, degree);
  if (low + high > 0.0) quality.contrast = (high - low) / (high + low);
}

std::vector<double> energy_shares(const Coefficients& radiance) {
  std::vector<double> shares(radiance.degree + 1, 0.0);
  double total = 0.0;
  for (int l = 0; l <= radiance.degree; ++l) {
    for (const auto& channel : radiance.channels) {
      for (int i = l * l; i < (l + 1) * (l + 1); ++i) shares[l] += channel[i] * channel[i];
    }
    total += shares[l];
  }
  if (!(total > 0.0)) return {};
  for (double& share : shares) share /= total;
  return shares;
}

void add_dominant_light(const Coefficients& radiance, LightQuality& quality) {
  if (radiance.degree < 1) return;
  const double mean = luminance(radiance, 0);
  if (mean > 0.0) quality.directionality = 0.0;
  const auto found = dominant_light(radiance);
  if (!found) {
    quality.fill_temperature = correlated_colour_temperature(mean_of(radiance));
    return;
  }
  if (mean > 0.0) quality.directionality = found->directionality;
  quality.dominant = {found->light.direction, found->light.irradiance, found->energy_share};
  quality.key_temperature = correlated_colour_temperature(found->light.irradiance);
  quality.fill_temperature = correlated_colour_temperature(mean_of(found->residual));
}

}  // namespace

LightQuality light_quality(const Coefficients& windowed, const std::vector<double>& gains,
                           const Coefficients& light) {
  LightQuality quality;
  quality.degree = windowed.degree;
  quality.window_gains = gains;
  if (light.degree > windowed.degree) quality.error = irradiance_error(windowed, light);
  add_irradiance_figures(windowed, quality);
  const Coefficients radiance = truncate(light, windowed.degree);
  quality.mean = mean_of(radiance);
  quality.energy_shares = energy_shares(radiance);
  add_dominant_light(radiance, quality);
  return quality;
}

}  // namespace shoal
