#include "scenes/lobe.h"

#include <algorithm>
#include <cmath>

#include "library/light.h"
#include "scenes/actors.h"
#include "scenes/scene_parts.h"

namespace shoal::viz {
namespace {

// Of the largest |f|; what coefficients of float precision leave of a constant is less.
constexpr double kLeastSpread = 1e-6;

}  // namespace

Lobe make_lobe(const Panorama& panorama, const SceneSettings& settings, int rings) {
  const Coefficients coefficients = shown_coefficients(panorama, settings);
  const Mesh sphere = sphere_mesh(rings);
  const std::vector<glm::dvec3> light = sample_on(sphere, coefficients);
  const std::vector<double> values = channel_of(light, settings.channel);
  const auto [smallest, largest] = std::minmax_element(values.begin(), values.end());

  Lobe lobe;
  lobe.degree = coefficients.degree;
  lobe.mean = channel_of(mean_of(coefficients), settings.channel);
  lobe.smallest = *smallest;
  lobe.largest = *largest;
  const double farthest = std::max(std::abs(*smallest), std::abs(*largest));
  lobe.unit = farthest > 0.0 ? farthest : 1.0;
  if (*largest - *smallest > kLeastSpread * farthest) {
    lobe.largest_direction = sphere.positions[largest - values.begin()];
  }
  lobe.mesh = lobe_mesh(sphere, values, 1.0 / lobe.unit);
  if (settings.colour == LobeColour::sign) {
    lobe.colours = sign_colours(lobe.mesh);
  } else {
    for (const glm::dvec3& colour : light) lobe.colours.push_back(pure_colour(colour));
  }
  return lobe;
}

}  // namespace shoal::viz
