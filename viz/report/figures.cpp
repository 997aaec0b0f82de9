#include "report/figures.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "library/light.h"
#include "sphere/dominant_light.h"
#include "sphere/light_quality.h"
#include "sphere/linear_operations.h"

namespace shoal::viz {
namespace {

constexpr double kDegreesPerRadian = 180.0 / std::numbers::pi;

// The coefficients are all that is known of the light: no error, and no window that they had.
QualityFigures measured(const Coefficients& radiance) {
  const std::vector<double> gains(radiance.degree + 1, 1.0);
  const LightQuality quality = light_quality(radiance, gains, radiance);
  QualityFigures figures;
  if (quality.least) figures.minimum_irradiance = quality.least->value;
  figures.negative_fraction = quality.negative_fraction;
  figures.contrast = quality.contrast;
  figures.directionality = quality.directionality;
  figures.key_temperature = quality.key_temperature;
  figures.fill_temperature = quality.fill_temperature;
  return figures;
}

}  // namespace

LightFigures light_figures(const Panorama& panorama) {
  const Coefficients radiance = radiance_of(panorama);
  LightFigures figures;
  figures.mean = mean_of(radiance);
  figures.mean_luminance = luminance(figures.mean);
  figures.quality = panorama.quality ? *panorama.quality : measured(radiance);
  if (const auto dominant = dominant_light(radiance)) {
    figures.direction = dominant->light.direction;
  }
  return figures;
}

double elevation_of(const glm::dvec3& native) {
  return kDegreesPerRadian * std::asin(std::clamp(native.z, -1.0, 1.0));
}

// The picture's centre is -x, a quarter turn to its right -y (sphere/conventions.h). The difference
// is +0 where -y would be -0, which the arc tangent takes for the other side of what is behind.
double azimuth_of(const glm::dvec3& native) {
  return kDegreesPerRadian * std::atan2(0.0 - native.y, -native.x);
}

}  // namespace shoal::viz
