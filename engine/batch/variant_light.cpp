#include "batch/variant_light.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "sphere/automatic_window.h"
#include "sphere/dominant_light.h"
#include "sphere/linear_operations.h"
#include "sphere/rotation.h"

namespace shoal {
namespace {

Coefficients with_lights(Coefficients radiance, const EntrySettings& settings) {
  // The projection of lights alone holds them already.
  if (settings.lights.empty() || settings.origin == LightOrigin::lights) return radiance;
  const int degree = radiance.degree;
  return add(std::move(radiance), project_lights(native_lights(settings), degree));
}

// A rest that is no more than the rounding of what was taken is none: figures and windows would
// take it for light.
Coefficients without_rounding(Coefficients rest, const Coefficients& whole) {
  constexpr double kRounding = 1e-14;
  for (int c = 0; c < kChannelCount; ++c) {
    const auto size = [](const std::vector<double>& values) {
      double largest = 0.0;
      for (const double value : values) largest = std::max(largest, std::abs(value));
      return largest;
    };
    if (size(rest.channels[c]) <= kRounding * size(whole.channels[c])) {
      std::ranges::fill(rest.channels[c], 0.0);
    }
  }
  return rest;
}

// The light is the same one however finely the rest is known.
Coefficients part_of(Coefficients light, DominantPart part) {
  if (part == DominantPart::keep) return light;
  auto found = dominant_light(light);
  if (part == DominantPart::remove) {
    return found ? without_rounding(std::move(found->residual), light) : std::move(light);
  }
  return found ? std::move(found->projected) : Coefficients(light.degree);
}

// All but the turn and the window.
Result<Coefficients> unturned(Coefficients radiance, const EntrySettings& settings,
                              const Variant& variant) {
  const glm::dmat3 mirror = mirror_of(settings, variant);
  if (mirror != glm::dmat3(1.0)) radiance = rotate(radiance, mirror);
  SHOAL_ASSIGN_OR_RETURN(matrix, combined_matrix(colour_of(settings, variant)));
  return apply_matrix(with_lights(std::move(radiance), settings), matrix);
}

// All but the window.
Result<Coefficients> before_window(const Coefficients& radiance, const EntrySettings& settings,
                                   const Variant& variant) {
  SHOAL_ASSIGN_OR_RETURN(turn, turn_of(settings, variant));
  SHOAL_ASSIGN_OR_RETURN(light, unturned(radiance, settings, variant));
  if (turn != glm::dmat3(1.0)) light = rotate(light, turn);
  return part_of(std::move(light), dominant_of(settings, variant));
}

}  // namespace

Result<std::vector<double>> VariantLights::gains_of(const Variant& variant) {
  const EntrySettings& settings = *entry_.settings;
  const WindowKey key = window_of(settings, variant);
  const int degree = projection_.radiance.degree;
  if (key.fit != WindowFit::automatic) return window_gains(key.window, degree);

  SHOAL_ASSIGN_OR_RETURN(matrix, combined_matrix(colour_of(settings, variant)));
  const glm::dmat3 mirror = mirror_of(settings, variant);
  const DominantPart dominant = dominant_of(settings, variant);
  for (const Fit& fit : fits_) {
    if (fit.matrix == matrix && fit.mirror == mirror && fit.dominant == dominant) return fit.gains;
  }
  SHOAL_ASSIGN_OR_RETURN(light, unturned(projection_.radiance, settings, variant));
  auto window = fit_window(part_of(std::move(light), dominant));
  if (!window) {
    Error error = std::move(window).error();
    error.where = entry_.name + (variant.name.empty() ? "" : ", variant " + variant.name);
    return error;
  }
  fits_.push_back({matrix, mirror, dominant, std::move(window->gains)});
  return fits_.back().gains;
}

Result<VariantLight> VariantLights::in(const Variant& variant) {
  SHOAL_ASSIGN_OR_RETURN(radiance, before_window(projection_.radiance, *entry_.settings, variant));
  SHOAL_ASSIGN_OR_RETURN(gains, gains_of(variant));
  VariantLight light;
  light.radiance = apply_gains(std::move(radiance), gains);
  light.gains = std::move(gains);
  return light;
}

Result<LightQuality> VariantLights::quality(const Variant& variant,
                                            const VariantLight& light) const {
  SHOAL_ASSIGN_OR_RETURN(
      exact, before_window(projection_.finer ? *projection_.finer : projection_.radiance,
                           *entry_.settings, variant));
  return light_quality(light.radiance, light.gains, exact);
}

Result<LightRecord> standout_lights(const Projection& projection, const PanoramaEntry& entry) {
  const EntrySettings& settings = *entry.settings;
  const Variant plain;
  SHOAL_ASSIGN_OR_RETURN(matrix, combined_matrix(colour_of(settings, plain)));
  SHOAL_ASSIGN_OR_RETURN(turn, turn_of(settings, plain));
  Variant whole;
  whole.linear.dominant = DominantPart::keep;
  SHOAL_ASSIGN_OR_RETURN(radiance, before_window(projection.radiance, settings, whole));
  LightRecord record;
  record.panorama = entry.name;
  record.frame = frame_of(settings, plain);
  record.sun = projection.sun;
  if (record.sun) {
    record.sun->direction = turn * mirror_of(settings, plain) * record.sun->direction;
    record.sun->irradiance = matrix * record.sun->irradiance;
    record.sun->flux = matrix * record.sun->flux;
  }
  if (const auto found = dominant_light(radiance)) {
    record.dominant = {found->light, found->directionality, found->energy_share};
  }
  return record;
}

Projection lights_alone(const EntrySettings& settings) {
  Projection projection;
  const std::vector<AnalyticLight> lights = native_lights(settings);
  const int degree = settings.projection.degree;
  const int highest = settings.projection.highest_degree();
  projection.radiance = project_lights(lights, degree);
  if (highest > degree) projection.finer = project_lights(lights, highest);
  projection.format = "lights in closed form";
  return projection;
}

}  // namespace shoal
