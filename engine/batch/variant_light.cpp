#include "batch/variant_light.h"

#include <algorithm>
#include <cmath>
#include <utility>

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

// The light is found to `degree`, so that it is the same one however finely the rest is known.
Coefficients part_of(Coefficients light, DominantPart part, int degree) {
  if (part == DominantPart::keep) return light;
  auto found = dominant_light(light, degree);
  if (part == DominantPart::remove) {
    return found ? without_rounding(std::move(found->residual), light) : std::move(light);
  }
  return found ? std::move(found->projected) : Coefficients(light.degree);
}

// All but the window.
Result<Coefficients> before_window(Coefficients radiance, const EntrySettings& settings,
                                   const Variant& variant) {
  SHOAL_ASSIGN_OR_RETURN(matrix, combined_matrix(colour_of(settings, variant)));
  SHOAL_ASSIGN_OR_RETURN(turn, turn_of(settings, variant));
  Coefficients light = apply_matrix(with_lights(std::move(radiance), settings), matrix);
  if (turn != glm::dmat3(1.0)) light = rotate(light, turn);
  return part_of(std::move(light), dominant_of(settings, variant), settings.projection.degree);
}

Status apply_window(const WindowKey& key, VariantLight& light) {
  if (key.fit == WindowFit::automatic) {
    SHOAL_ASSIGN_OR_RETURN(fitted, fit_window(light.radiance));
    light.gains = fitted.gains;
    light.fitted = std::move(fitted);
  } else {
    light.gains = window_gains(key.window, light.radiance.degree);
  }
  light.radiance = apply_gains(std::move(light.radiance), light.gains);
  return {};
}

}  // namespace

Result<VariantLight> variant_light(const Projection& projection, const PanoramaEntry& entry,
                                   const Variant& variant) {
  const EntrySettings& settings = *entry.settings;
  SHOAL_ASSIGN_OR_RETURN(radiance, before_window(projection.radiance, settings, variant));
  VariantLight light;
  light.radiance = std::move(radiance);
  if (Status status = apply_window(window_of(settings, variant), light); !status) {
    Error error = std::move(status).error();
    error.where = entry.name + (variant.name.empty() ? "" : ", variant " + variant.name);
    return error;
  }
  return light;
}

Result<LightQuality> variant_quality(const Projection& projection, const PanoramaEntry& entry,
                                     const Variant& variant) {
  SHOAL_ASSIGN_OR_RETURN(windowed, variant_light(projection, entry, variant));
  SHOAL_ASSIGN_OR_RETURN(light, before_window(projection.finer.value_or(projection.radiance),
                                              *entry.settings, variant));
  return light_quality(windowed.radiance, windowed.gains, light);
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
    record.sun->direction = turn * record.sun->direction;
    record.sun->irradiance = matrix * record.sun->irradiance;
    record.sun->flux = matrix * record.sun->flux;
  }
  if (const auto found = dominant_light(radiance, radiance.degree)) {
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
