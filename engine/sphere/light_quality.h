// What is good to know of a panorama's light before it is used: how well its coefficients stand for
// it, and what light it is.
#pragma once

#include <glm/vec3.hpp>
#include <optional>
#include <vector>

#include "sphere/coefficients.h"
#include "sphere/irradiance_error.h"
#include "sphere/least_irradiance.h"

namespace shoal {

// Luminance: of linear Rec.709. A figure that the light does not have is empty.
struct LightQuality {
  int degree = 0;  // L, of the coefficients that tables hold

  // Of the irradiance as tables hold it, to degree L and with its window.
  std::optional<IrradianceError> error;  // where the light is known to a higher degree
  // Least over directions and channels, in units of the channel's mean; not where a channel's mean
  // is not positive.
  std::optional<LeastIrradiance> least;
  // Of the sphere, where the luminance's irradiance is below zero (sphere/negative_share.h): to
  // about 1e-4.
  double negative_fraction = 0.0;
  // (max - min) / (max + min) of the luminance's irradiance: 0 for a constant environment, 1 where
  // a direction gets nothing. Not where max + min is not positive.
  std::optional<double> contrast;
  std::vector<double> window_gains;  // a degree; all 1 without a window

  // Of the light itself to degree L, without a window.
  glm::dvec3 mean{0.0};  // radiance over the sphere
  // The part of each degree in sum_lm L_lm^2 over channels; empty where there is no light.
  std::vector<double> energy_shares;

  // The dominant directional light (sphere/dominant_light.h).
  struct Dominant {
    glm::dvec3 direction{0.0, 0.0, 1.0};  // unit, in the coefficients' frame
    glm::dvec3 irradiance{0.0};           // of a surface that faces it
    double energy_share = 0.0;

    friend bool operator==(const Dominant&, const Dominant&) = default;
  };
  std::optional<Dominant> dominant;
  // Of the luminance, |degree 1| / (sqrt(3) L_00): 0 for light that comes alike from opposite
  // sides, 1 for one point. Not without degree 1, nor where the mean is not positive.
  std::optional<double> directionality;
  // Correlated colour temperatures in kelvin (sphere/colour_temperature.h): of the dominant light,
  // and of the mean of what is left without it.
  std::optional<double> key_temperature;
  std::optional<double> fill_temperature;

  friend bool operator==(const LightQuality&, const LightQuality&) = default;
};

// `windowed`: radiance to degree L with its window, whose gains are `gains`. `light`: the same
// without the window, to degree L or higher; higher, it gives `error`. The extremes of irradiance
// are refined. Precondition: coefficients are finite; light's degree >= L.
[[nodiscard]] LightQuality light_quality(const Coefficients& windowed,
                                         const std::vector<double>& gains,
                                         const Coefficients& light);

}  // namespace shoal
