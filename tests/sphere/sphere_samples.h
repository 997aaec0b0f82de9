// Directions and coefficients that the tests of this folder draw, the same in every run.
#pragma once

#include <cmath>
#include <glm/glm.hpp>
#include <random>
#include <vector>

#include "sphere/coefficients.h"

namespace shoal::test {

// Uniform on the sphere, from a fixed seed.
inline std::vector<glm::dvec3> random_directions(int count) {
  std::mt19937_64 engine(20010812);
  std::normal_distribution<double> normal;
  std::vector<glm::dvec3> directions;
  while (static_cast<int>(directions.size()) < count) {
    const glm::dvec3 v(normal(engine), normal(engine), normal(engine));
    if (glm::length(v) > 1e-3) directions.push_back(glm::normalize(v));
  }
  return directions;
}

// Every number uniform in [-1, 1].
inline Coefficients random_coefficients(int degree) {
  std::mt19937_64 engine(degree + 1);
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  Coefficients coefficients(degree);
  for (auto& channel : coefficients.channels) {
    for (double& value : channel) value = uniform(engine);
  }
  return coefficients;
}

inline double largest_difference(const Coefficients& a, const Coefficients& b) {
  double largest = 0.0;
  for (int c = 0; c < kChannelCount; ++c) {
    for (std::size_t i = 0; i < a.channels[c].size(); ++i) {
      largest = std::max(largest, std::abs(a.channels[c][i] - b.channels[c][i]));
    }
  }
  return largest;
}

}  // namespace shoal::test
