// What a table or map holds of a panorama's light, as gains of its radiance coefficients a degree.
#pragma once

#include <string_view>

#include "core/result.h"
#include "sphere/coefficients.h"

namespace shoal {

// A_l, by which convolution with the clamped cosine max(0, cos) multiplies degree l: pi, 2 pi/3,
// pi/4, 0, -pi/24 ... Relative error 1e-15. Source: Ramamoorthi & Hanrahan, "On the relationship
// between radiance and irradiance", J. Opt. Soc. Am. A 18 (2001), eq. 24-26. Precondition: l >= 0.
[[nodiscard]] double clamped_cosine_gain(int l);

enum class Quantity {
  radiance,            // L_lm
  irradiance,          // A_l L_lm: pi everywhere under a constant environment of radiance 1
  irradiance_over_pi,  // A_l L_lm / pi: 1 there, the light that leaves a white diffuse surface
};

// "radiance", "irradiance", "irradiance-over-pi".
[[nodiscard]] std::string_view name_of(Quantity quantity);

// The quantity of such a name; "irradiance_over_pi" is one too. Error: usage, with the nearest
// name.
[[nodiscard]] Result<Quantity> parse_quantity(std::string_view name);

// The gain of degree l from radiance to the quantity.
[[nodiscard]] double quantity_gain(Quantity quantity, int l);

// The quantity's coefficients. Radiance comes back with the bits it had.
[[nodiscard]] Coefficients apply_quantity(Coefficients radiance, Quantity quantity);

}  // namespace shoal
