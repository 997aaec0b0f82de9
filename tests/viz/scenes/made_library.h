// A library that tests make: no files, no program, coefficients in closed form.
#pragma once

#include <cmath>
#include <glm/geometric.hpp>
#include <string>
#include <vector>

#include "library/library.h"
#include "sphere/basis.h"

namespace shoal::test {

// An RGB light from one direction of the native frame, to a degree: radiance is a delta function,
// so L_lm = colour Y_lm(direction).
inline Coefficients light_from(const glm::dvec3& direction, const glm::dvec3& colour, int degree) {
  std::vector<double> values(coefficient_count(degree));
  Basis<double>(degree).evaluate(glm::normalize(direction), values);
  Coefficients coefficients(degree);
  for (int c = 0; c < 3; ++c) {
    for (std::size_t i = 0; i < values.size(); ++i) {
      coefficients.channels[c][i] = colour[c] * values[i];
    }
  }
  return coefficients;
}

inline viz::Panorama panorama_of(const std::string& name, Coefficients radiance) {
  viz::Panorama panorama;
  panorama.name = name;
  panorama.coefficients = std::move(radiance);
  return panorama;
}

// A sky of constant radiance, with a warm light ahead and above, and a blue one behind.
inline viz::Library made_library() {
  Coefficients sum = light_from({-0.7, -0.5, 0.5}, {3.0, 2.4, 1.6}, 6);
  const Coefficients blue = light_from({0.9, 0.2, 0.1}, {0.3, 0.5, 1.0}, 6);
  for (int c = 0; c < 3; ++c) {
    for (std::size_t i = 0; i < sum.channels[c].size(); ++i) {
      sum.channels[c][i] += blue.channels[c][i];
    }
    sum.channels[c][0] += 0.4 * std::sqrt(4.0 * 3.14159265358979323846);
  }
  viz::Library library;
  library.title = "made";
  library.panoramas = {panorama_of("two lights", std::move(sum)),
                       panorama_of("zenith", light_from({0.0, 0.0, 1.0}, {1.0, 1.0, 1.0}, 4))};
  return library;
}

}  // namespace shoal::test
