// A window over degrees, for the eye: how much of a lobe's rippling is the sum's abrupt end.
#pragma once

#include <cstddef>
#include <optional>
#include <span>

#include "library/library.h"
#include "sphere/coefficients.h"

namespace shoal::viz {

// The coefficients to `degree`, or to where they end before, under the Hann window of that degree
// (sphere/degree_window.h). It multiplies whole degrees, as the clamped cosine does, so windowed
// irradiance is the irradiance of windowed radiance.
[[nodiscard]] Coefficients hann_windowed(Coefficients coefficients, std::optional<int> degree);

// The library with these panoramas windowed, each as a variant whose name says so. The others have
// no coefficients: it is made anew whenever others are looked at.
[[nodiscard]] Library hann_windowed(const Library& library, std::span<const std::size_t> panoramas,
                                    std::optional<int> degree);

}  // namespace shoal::viz
