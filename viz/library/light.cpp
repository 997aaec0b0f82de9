#include "library/light.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "sphere/dominant_light.h"
#include "sphere/linear_operations.h"

namespace shoal::viz {

glm::dvec3 colour_at(const Coefficients& coefficients, int i) {
  return {coefficients.channels[0][i], coefficients.channels[1][i], coefficients.channels[2][i]};
}

glm::dvec3 mean_of(const Coefficients& coefficients) {
  return colour_at(coefficients, 0) / std::sqrt(4.0 * std::numbers::pi);
}

std::optional<double> dominance_of(const Coefficients& radiance) {
  if (radiance.degree < 1 || luminance(radiance, 0) <= 0.0) return std::nullopt;
  const auto found = dominant_light(radiance);
  return found ? found->directionality : 0.0;
}

double exposure_of_mean(const glm::dvec3& mean) {
  const double brightness = luminance(mean);
  if (!std::isfinite(brightness) || brightness <= 0.0) return 1.0;
  return kMeanTone / std::max({brightness, 0.5 * mean.r, 0.5 * mean.g, 0.5 * mean.b});
}

double automatic_exposure(const Coefficients& radiance, double stops) {
  return exposure_of_mean(mean_of(radiance)) * std::exp2(stops);
}

double srgb_encoded(double linear) {
  const double x = std::clamp(linear, 0.0, 1.0);
  return x <= 0.0031308 ? 12.92 * x : 1.055 * std::pow(x, 1.0 / 2.4) - 0.055;
}

double srgb_decoded(double encoded) {
  return encoded <= 0.04045 ? encoded / 12.92 : std::pow((encoded + 0.055) / 1.055, 2.4);
}

}  // namespace shoal::viz
