#include "scenes/equirect.h"

#include <cmath>
#include <numbers>

#include "sphere/equirect_evaluator.h"

namespace shoal::viz {
namespace {

constexpr double kPi = std::numbers::pi;

}  // namespace

Pixels synthesise(const Coefficients& native, int width, int height) {
  Pixels pixels;
  pixels.width = width;
  pixels.height = height;
  pixels.rgb.resize(std::size_t{3} * width * height);
  const EquirectEvaluator evaluator(native.degree, width, height);
  std::vector<double> row(width);
  for (int i = 0; i < height; ++i) {
    float* first = pixels.rgb.data() + std::size_t{3} * i * width;
    for (int c = 0; c < kChannelCount; ++c) {
      evaluator.evaluate(native.channels[c], i, row);
      for (int j = 0; j < width; ++j) first[3 * j + c] = static_cast<float>(row[j]);
    }
  }
  return pixels;
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
