// What the tests of engine profiles share: light, frames, and numbers read back from files.
#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <glm/glm.hpp>
#include <numbers>
#include <random>
#include <regex>
#include <string>
#include <vector>

#include "output/profile.h"
#include "sphere/basis.h"

namespace shoal::test {

// Radiance coefficients without any symmetry: uniform in [-1, 1], on a constant.
inline Coefficients random_light(int degree) {
  std::mt19937_64 engine(20010812);
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  Coefficients light(degree);
  for (auto& channel : light.channels) {
    for (double& value : channel) value = uniform(engine);
    channel[0] += 3.0;
  }
  return light;
}

inline std::vector<glm::dvec3> hundred_directions() {
  std::mt19937_64 engine(7);
  std::normal_distribution<double> normal;
  std::vector<glm::dvec3> directions;
  while (directions.size() < 100) {
    const glm::dvec3 v(normal(engine), normal(engine), normal(engine));
    if (glm::length(v) > 1e-3) directions.push_back(glm::normalize(v));
  }
  return directions;
}

// Where the panorama's centre, right and up lie in a consumer's axes.
struct Axes {
  glm::dvec3 center;
  glm::dvec3 right;
  glm::dvec3 up;

  // The native direction, whose centre is -x, right -y and up +z, of a direction of the consumer's.
  [[nodiscard]] glm::dvec3 native(const glm::dvec3& d) const {
    return {-glm::dot(d, center), -glm::dot(d, right), glm::dot(d, up)};
  }
};

// Irradiance of native radiance coefficients, to `degree`, in a consumer's direction.
inline glm::dvec3 irradiance_at(const Coefficients& radiance, int degree, const Axes& axes,
                                const glm::dvec3& direction) {
  Coefficients cut = radiance;
  cut.degree = degree;
  for (auto& channel : cut.channels) channel.resize(coefficient_count(degree));
  return evaluate(apply_quantity(cut, Quantity::irradiance), axes.native(direction));
}

// The sum of |E_lm| in a channel, which errors are measured by: |Y_lm| < 1.1 to degree 2.
inline double irradiance_size(const Coefficients& radiance) {
  double largest = 0.0;
  for (const auto& channel : apply_quantity(radiance, Quantity::irradiance).channels) {
    double sum = 0.0;
    for (const double value : channel) sum += std::abs(value);
    largest = std::max(largest, sum);
  }
  return largest;
}

// The numbers of a text behind `begin` and before the next `end`, or to the end.
inline std::vector<double> numbers_in(const std::string& text, const std::string& begin,
                                      const std::string& end = "") {
  const std::size_t first = text.find(begin);
  if (first == text.npos) return {};
  const std::size_t from = first + begin.size();
  const std::string part = text.substr(from, end.empty() ? text.npos : text.find(end, from) - from);
  static const std::regex kNumber(R"([-+]?[0-9]+\.?[0-9]*(e[-+]?[0-9]+)?)");
  std::vector<double> numbers;
  for (std::sregex_iterator it(part.begin(), part.end(), kNumber), last; it != last; ++it) {
    numbers.push_back(std::stod(it->str()));
  }
  return numbers;
}

using Options = std::vector<std::pair<std::string, std::string>>;

inline std::string export_text(const std::string& name, const Options& options,
                               const Coefficients& radiance) {
  auto profile = find_profile(name);
  EXPECT_TRUE(profile) << profile.error().text();
  if (!profile) return "";
  auto chosen = with_options(std::move(*profile), options);
  EXPECT_TRUE(chosen) << chosen.error().text();
  if (!chosen) return "";
  auto text = write_profile_text(*chosen, radiance, {"hall", "plain"});
  EXPECT_TRUE(text) << text.error().text();
  return text ? *text : "";
}

}  // namespace shoal::test
