#include "app/hann_window.h"

#include <cmath>
#include <numbers>
#include <utility>

#include "sphere/linear_operations.h"

namespace shoal::viz {

Coefficients hann_windowed(Coefficients coefficients, std::optional<int> degree) {
  if (degree) coefficients = truncate(std::move(coefficients), *degree);
  for (int l = 1; l <= coefficients.degree; ++l) {
    const double gain = 0.5 * (1.0 + std::cos(std::numbers::pi * l / (coefficients.degree + 1)));
    for (int m = -l; m <= l; ++m) {
      for (auto& channel : coefficients.channels) channel[coefficient_index(l, m)] *= gain;
    }
  }
  return coefficients;
}

Library hann_windowed(const Library& library, std::span<const std::size_t> panoramas,
                      std::optional<int> degree) {
  Library windowed;
  windowed.title = library.title;
  windowed.panoramas.resize(library.panoramas.size());
  for (const std::size_t index : panoramas) {
    Panorama& panorama = windowed.panoramas[index];
    panorama = library.panoramas[index];
    panorama.variant += panorama.variant.empty() ? "Hann window" : ", Hann window";
    panorama.coefficients = hann_windowed(std::move(panorama.coefficients), degree);
  }
  return windowed;
}

}  // namespace shoal::viz
