// What light is to the eye: how bright, from where, and how scenes and reports make pictures of it.
#pragma once

#include <glm/vec3.hpp>
#include <optional>

#include "sphere/coefficients.h"

namespace shoal::viz {

// Coefficient i of all channels. Precondition: there is one.
[[nodiscard]] glm::dvec3 colour_at(const Coefficients& coefficients, int i);

// The mean over the sphere, RGB: L_00 / sqrt(4 pi).
[[nodiscard]] glm::dvec3 mean_of(const Coefficients& coefficients);

// The directionality of sphere/dominant_light.h: 0 for light that comes alike from opposite sides,
// 1 for one point. Not without degree 1, nor where the mean is not positive.
[[nodiscard]] std::optional<double> dominance_of(const Coefficients& radiance);

// What the automatic exposure brings a panorama's mean luminance to. A photographer's mid grey,
// 0.18, would be for a scene whose highlights are a few times its mean; the mean of a panorama
// holds its sun and lamps, and what is beside them lies well below it.
inline constexpr double kMeanTone = 0.3;

// The exposure that does so, or the lower one at which the mean of no channel is above twice that,
// so that one colour alone is not burnt out; 1 where the mean luminance is not positive.
[[nodiscard]] double exposure_of_mean(const glm::dvec3& mean);

// The same of radiance, times 2^stops.
[[nodiscard]] double automatic_exposure(const Coefficients& radiance, double stops = 0.0);

// The sRGB curve (IEC 61966-2-1) of a linear value, clamped to 0..1.
[[nodiscard]] double srgb_encoded(double linear);

// The value that has this code.
[[nodiscard]] double srgb_decoded(double encoded);

}  // namespace shoal::viz
