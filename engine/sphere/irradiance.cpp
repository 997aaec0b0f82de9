#include "sphere/irradiance.h"

#include <algorithm>
#include <array>
#include <numbers>
#include <string>

#include "core/diagnostic.h"

namespace shoal {
namespace {

constexpr std::array<std::string_view, 3> kNames = {"radiance", "irradiance", "irradiance-over-pi"};

// A_l / pi. For even l: 2 (-1)^(l/2-1) / ((l+2)(l-1)) * l! / (2^l (l/2)!^2), the last factor as the
// product of (2k-1)/(2k), k = 1..l/2, so that nothing overflows.
double clamped_cosine_gain_over_pi(int l) {
  if (l == 1) return 2.0 / 3.0;
  if (l % 2 == 1) return 0.0;
  double gain = 2.0 / ((l + 2) * (l - 1.0));
  for (int k = 1; k <= l / 2; ++k) gain *= -(2 * k - 1.0) / (2 * k);
  return -gain;
}

}  // namespace

double clamped_cosine_gain(int l) { return std::numbers::pi * clamped_cosine_gain_over_pi(l); }

std::string_view name_of(Quantity quantity) { return kNames[static_cast<int>(quantity)]; }

Result<Quantity> parse_quantity(std::string_view name) {
  std::string hyphened(name);
  std::replace(hyphened.begin(), hyphened.end(), '_', '-');
  const auto found = std::find(kNames.begin(), kNames.end(), hyphened);
  if (found != kNames.end()) return static_cast<Quantity>(found - kNames.begin());
  const std::string_view near = closest_match(hyphened, kNames);
  return Error{ErrorCode::usage, "unknown quantity \"" + std::string(name) + "\"", "",
               near.empty() ? "use radiance, irradiance or irradiance-over-pi"
                            : "did you mean \"" + std::string(near) + "\"?"};
}

double quantity_gain(Quantity quantity, int l) {
  switch (quantity) {
    case Quantity::radiance:
      return 1.0;
    case Quantity::irradiance:
      return clamped_cosine_gain(l);
    case Quantity::irradiance_over_pi:
      return clamped_cosine_gain_over_pi(l);
  }
  return 1.0;
}

Coefficients apply_quantity(Coefficients radiance, Quantity quantity) {
  if (quantity == Quantity::radiance) return radiance;
  for (int l = 0; l <= radiance.degree; ++l) {
    const double gain = quantity_gain(quantity, l);
    for (auto& channel : radiance.channels) {
      for (int m = -l; m <= l; ++m) channel[coefficient_index(l, m)] *= gain;
    }
  }
  return radiance;
}

}  // namespace shoal
