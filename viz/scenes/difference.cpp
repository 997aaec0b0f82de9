#include "scenes/difference.h"

#include <algorithm>
#include <cmath>

#include "scenes/colours.h"
#include "scenes/equirect.h"
#include "scenes/mesh.h"

namespace shoal::viz {
namespace {

std::vector<double> values_of(const Pixels& pixels, Channel channel) {
  std::vector<double> values;
  values.reserve(pixels.rgb.size() / 3);
  for (std::size_t i = 0; i + 2 < pixels.rgb.size(); i += 3) {
    values.push_back(
        channel_of(glm::dvec3(pixels.rgb[i], pixels.rgb[i + 1], pixels.rgb[i + 2]), channel));
  }
  return values;
}

double rms_over_sphere(const Pixels& like, std::vector<double> values) {
  for (double& value : values) value *= value;
  return std::sqrt(sphere_mean(like, values));
}

}  // namespace

Difference difference_of(const Pixels& left, const Pixels& right, Channel channel) {
  const std::vector<double> before = values_of(left, channel);
  Difference difference;
  difference.values = values_of(right, channel);
  std::vector<double> magnitudes(before.size());
  for (std::size_t i = 0; i < before.size(); ++i) {
    difference.values[i] -= before[i];
    magnitudes[i] = std::abs(difference.values[i]);
  }
  difference.rms = rms_over_sphere(left, difference.values);
  const double reference = rms_over_sphere(left, before);
  difference.relative_rms = reference > 0.0 ? difference.rms / reference : 0.0;
  const auto largest = std::ranges::max_element(magnitudes);
  difference.largest = *largest;
  difference.largest_texel = static_cast<std::size_t>(largest - magnitudes.begin());
  const double inside = (1.0 - kBeyondScale) * static_cast<double>(magnitudes.size() - 1);
  const auto end_of_scale = magnitudes.begin() + static_cast<std::ptrdiff_t>(std::ceil(inside));
  std::ranges::nth_element(magnitudes, end_of_scale);
  if (*end_of_scale > 0.0) difference.scale = *end_of_scale;
  const auto beyond = std::ranges::count_if(
      magnitudes, [&](double magnitude) { return magnitude > difference.scale; });
  difference.beyond = static_cast<double>(beyond) / static_cast<double>(magnitudes.size());
  return difference;
}

Picture difference_picture(const Difference& difference, const Pixels& like) {
  Picture picture{{like.width, like.height}, {}};
  picture.rgb.reserve(3 * difference.values.size());
  for (const double value : difference.values) {
    const glm::vec3 colour = diverging_colour(value / difference.scale);
    for (int c = 0; c < 3; ++c) {
      picture.rgb.push_back(static_cast<unsigned char>(std::lround(255.0f * colour[c])));
    }
  }
  return picture;
}

}  // namespace shoal::viz
