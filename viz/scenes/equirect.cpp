#include "scenes/equirect.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "sphere/legendre.h"

namespace shoal::viz {
namespace {

constexpr double kPi = std::numbers::pi;

// cos(m phi_j) and sin(m phi_j) of all columns, (degree+1, width) each.
struct ColumnTables {
  std::vector<double> cosines;
  std::vector<double> sines;

  ColumnTables(int degree, int width) {
    cosines.reserve(static_cast<std::size_t>(degree + 1) * width);
    sines.reserve(cosines.capacity());
    for (int m = 0; m <= degree; ++m) {
      for (int j = 0; j < width; ++j) {
        const double angle = 2.0 * kPi * m * (j + 0.5) / width;
        cosines.push_back(std::cos(angle));
        sines.push_back(std::sin(angle));
      }
    }
  }
};

// One row of one channel, (width) values at a stride of three floats.
void synthesise_row(const std::vector<double>& coefficients, int degree,
                    const std::vector<double>& legendre, const ColumnTables& columns, int width,
                    std::vector<double>& row, float* out) {
  row.assign(width, 0.0);
  for (int m = 0; m <= degree; ++m) {
    double cosine_part = 0.0;
    double sine_part = 0.0;
    for (int l = m; l <= degree; ++l) {
      const double value = legendre[legendre_index(l, m)];
      cosine_part += value * coefficients[coefficient_index(l, m)];
      if (m > 0) sine_part += value * coefficients[coefficient_index(l, -m)];
    }
    const double* cosines = columns.cosines.data() + static_cast<std::ptrdiff_t>(m) * width;
    const double* sines = columns.sines.data() + static_cast<std::ptrdiff_t>(m) * width;
    for (int j = 0; j < width; ++j) row[j] += cosine_part * cosines[j] + sine_part * sines[j];
  }
  for (int j = 0; j < width; ++j) out[3 * j] = static_cast<float>(row[j]);
}

}  // namespace

Pixels synthesise(const Coefficients& native, int width, int height) {
  Pixels pixels;
  pixels.width = width;
  pixels.height = height;
  pixels.rgb.resize(std::size_t{3} * pixels.width * pixels.height);
  const AssociatedLegendre<double> legendre(native.degree);
  const ColumnTables columns(native.degree, width);
  std::vector<double> values(legendre_count(native.degree));
  std::vector<double> row;
  for (int i = 0; i < pixels.height; ++i) {
    const double theta = kPi * (i + 0.5) / pixels.height;
    legendre.evaluate(std::cos(theta), std::sin(theta), values);
    float* first = pixels.rgb.data() + std::size_t{3} * i * width;
    for (int c = 0; c < kChannelCount; ++c) {
      synthesise_row(native.channels[c], native.degree, values, columns, width, row, first + c);
    }
  }
  return pixels;
}

glm::dvec2 place_of(const glm::dvec3& native) {
  const double turn = std::atan2(native.y, native.x) / (2.0 * kPi);
  return {turn - std::floor(turn), std::acos(std::clamp(native.z, -1.0, 1.0)) / kPi};
}

double sphere_mean(const Pixels& like, const std::vector<double>& values) {
  double sum = 0.0;
  for (int i = 0; i < like.height; ++i) {
    double row = 0.0;
    for (int j = 0; j < like.width; ++j) {
      row += values[static_cast<std::size_t>(i) * like.width + j];
    }
    const double weight = std::cos(kPi * i / like.height) - std::cos(kPi * (i + 1) / like.height);
    sum += weight * row;
  }
  return sum / (2.0 * like.width);
}

}  // namespace shoal::viz
