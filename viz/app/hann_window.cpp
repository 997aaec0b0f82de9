#include "app/hann_window.h"

#include <utility>

#include "sphere/degree_window.h"
#include "sphere/linear_operations.h"

namespace shoal::viz {

Coefficients hann_windowed(Coefficients coefficients, std::optional<int> degree) {
  if (degree) coefficients = truncate(std::move(coefficients), *degree);
  const auto gains = window_gains({WindowKind::hann, {}}, coefficients.degree);
  return apply_gains(std::move(coefficients), gains);
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
