#include "sphere/irradiance_error.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>
#include <utility>
#include <vector>

#include "sphere/basis.h"
#include "sphere/irradiance.h"

namespace shoal {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr int kRowsPerDegree = 4;

double square_norm(const Coefficients& coefficients) {
  double sum = 0.0;
  for (const auto& channel : coefficients.channels) {
    for (const double value : channel) sum += value * value;
  }
  return sum;
}

// Irradiance to the higher degree of `exact`.
Coefficients difference(const Coefficients& approximate, const Coefficients& exact) {
  Coefficients result = exact;
  for (int c = 0; c < kChannelCount; ++c) {
    auto& channel = result.channels[c];
    for (double& value : channel) value = -value;
    for (std::size_t i = 0; i < approximate.channels[c].size(); ++i) {
      channel[i] += approximate.channels[c][i];
    }
  }
  return apply_quantity(std::move(result), Quantity::irradiance);
}

void find_maximum(const Coefficients& difference, const Coefficients& exact,
                  IrradianceError& error) {
  const int rows = kRowsPerDegree * (difference.degree + 1);
  for (int c = 0; c < kChannelCount; ++c) {
    // E_00 / sqrt(4 pi), E_00 = pi L_00.
    const double mean = kPi * exact.channels[c][0] / std::sqrt(4.0 * kPi);
    if (!(mean > 0.0)) continue;
    const auto& channel = difference.channels[c];
    const EquirectValues grid = equirect_values(channel, difference.degree, rows);
    for (const Extremum which : {Extremum::least, Extremum::greatest}) {
      const DirectedValue found = extremum_of(channel, difference.degree, grid, which);
      if (std::abs(found.value) / mean <= error.maximum) continue;
      error.maximum = std::abs(found.value) / mean;
      error.direction = found.direction;
    }
  }
}

}  // namespace

std::optional<IrradianceError> irradiance_error(const Coefficients& approximate,
                                                const Coefficients& exact) {
  const double whole = square_norm(apply_quantity(exact, Quantity::irradiance));
  if (!(whole > 0.0)) return std::nullopt;
  const Coefficients off = difference(approximate, exact);
  IrradianceError error;
  error.degree = exact.degree;
  error.relative_rms = std::sqrt(square_norm(off) / whole);
  find_maximum(off, exact, error);
  return error;
}

std::optional<IrradianceError> irradiance_error(const Coefficients& approximate,
                                                const DirectionGrid& grid,
                                                std::span<const glm::dvec3> irradiance) {
  const std::size_t count = grid.directions.size();
  glm::dvec3 mean(0.0);
  double whole = 0.0;
  for (std::size_t i = 0; i < count; ++i) {
    mean += grid.weights[i] / (4.0 * kPi) * irradiance[i];
    whole += grid.weights[i] * glm::dot(irradiance[i], irradiance[i]);
  }
  if (!(whole > 0.0)) return std::nullopt;
  const Coefficients sum = apply_quantity(approximate, Quantity::irradiance);
  const Basis<double> basis(sum.degree);
  std::vector<double> y(coefficient_count(sum.degree));
  IrradianceError error;
  error.degree = static_cast<int>(std::lround(std::sqrt(2.0 * static_cast<double>(count)))) - 1;
  double off = 0.0;
  for (std::size_t i = 0; i < count; ++i) {
    basis.evaluate(grid.directions[i], y);
    const glm::dvec3 gap = evaluate(sum, y) - irradiance[i];
    off += grid.weights[i] * glm::dot(gap, gap);
    for (int c = 0; c < kChannelCount; ++c) {
      if (!(mean[c] > 0.0) || std::abs(gap[c]) / mean[c] <= error.maximum) continue;
      error.maximum = std::abs(gap[c]) / mean[c];
      error.direction = grid.directions[i];
    }
  }
  error.relative_rms = std::sqrt(off / whole);
  return error;
}

IrradianceBeyond irradiance_beyond(int degree) {
  double energy = 2.0 * kPi / 3.0;  // of the clamped cosine
  double side = 0.0;                // its sum at right angles
  double legendre = 1.0;            // P_l(0)
  for (int l = 0; l <= degree; ++l) {
    if (l > 0 && l % 2 == 0) legendre *= -(l - 1.0) / l;
    const double gain = clamped_cosine_gain(l);
    energy -= gain * gain * (2 * l + 1) / (4.0 * kPi);
    if (l % 2 == 0) side += gain * (2 * l + 1) / (4.0 * kPi) * legendre;
  }
  return {4.0 * std::sqrt(std::max(0.0, energy) / (4.0 * kPi)), 4.0 * std::abs(side)};
}

}  // namespace shoal
