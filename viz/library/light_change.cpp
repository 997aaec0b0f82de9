#include "library/light_change.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <vector>

#include "library/light.h"
#include "sphere/linear_operations.h"
#include "sphere/rotation.h"

namespace shoal::viz {
namespace {

// Of all of the light. Rotations and products leave 1e-13 or so, and a turn that is found from
// vectors no less than kApart apart the inverse of it more.
constexpr double kRounding = 1e-9;
constexpr double kApart = 1e-3;

using Vectors = std::array<glm::dvec3, 4>;

double squared(const Coefficients& light) {
  double sum = 0.0;
  for (const auto& channel : light.channels) {
    for (const double value : channel) sum += value * value;
  }
  return sum;
}

// Whether each degree of `told` is that of `made` times a factor from 0 to 1, a window's, which
// leaves degree 0 alone.
bool explains(const Coefficients& made, const Coefficients& told) {
  const double allowed = kRounding * kRounding * squared(told);
  double missed = 0.0;
  for (int l = 0; l <= told.degree; ++l) {
    double together = 0.0;
    double own = 0.0;
    const auto sum_up = [&](auto term) {
      for (int c = 0; c < kChannelCount; ++c) {
        for (int m = -l; m <= l; ++m) {
          const int i = coefficient_index(l, m);
          term(made.channels[c][i], told.channels[c][i]);
        }
      }
    };
    sum_up([&](double a, double b) {
      together += a * b;
      own += a * a;
    });
    const double gain = l > 0 && own > 0.0 ? std::clamp(together / own, 0.0, 1.0) : 1.0;
    sum_up([&](double a, double b) { missed += (b - gain * a) * (b - gain * a); });
  }
  return missed <= allowed;
}

// A factor a channel, which degree 0 tells: no rotation and no window touches it.
std::optional<glm::dmat3> factors(const Coefficients& own, const Coefficients& told) {
  glm::dmat3 colour(1.0);
  for (int c = 0; c < kChannelCount; ++c) {
    const double before = own.channels[c][0];
    const double after = told.channels[c][0];
    if (before == 0.0 && after != 0.0) return std::nullopt;
    if (before != 0.0) colour[c][c] = after / before;
  }
  return colour;
}

// The matrix with the least squares of what it misses. Not where the channels are so nearly one
// another's multiples that the pixels could tell another one.
std::optional<glm::dmat3> least_squares(const Coefficients& own, const Coefficients& told) {
  constexpr double kLeastVolume = 1e-9;
  glm::dmat3 gram(0.0);
  glm::dmat3 mixed(0.0);
  for (std::size_t i = 0; i < own.channels[0].size(); ++i) {
    const glm::dvec3 before = colour_at(own, static_cast<int>(i));
    gram += glm::outerProduct(before, before);
    mixed += glm::outerProduct(colour_at(told, static_cast<int>(i)), before);
  }
  const double size = (gram[0][0] + gram[1][1] + gram[2][2]) / 3.0;
  if (!(glm::determinant(gram) > kLeastVolume * size * size * size)) return std::nullopt;
  return mixed * glm::inverse(gram);
}

// Where degree 1 of each channel points, and the vertical, which many rotations keep.
Vectors landmarks(const Coefficients& light) {
  Vectors vectors;
  for (int c = 0; c < kChannelCount; ++c) {
    const auto& channel = light.channels[c];
    vectors[c] = {channel[coefficient_index(1, 1)], channel[coefficient_index(1, -1)],
                  channel[coefficient_index(1, 0)]};
  }
  vectors[3] = {0.0, 0.0, 1.0};
  return vectors;
}

// A right-handed orthonormal basis whose first two span a and b. Zero where these are too near one
// line.
glm::dmat3 basis_of(const glm::dvec3& a, const glm::dvec3& b) {
  const glm::dvec3 across = glm::cross(a, b);
  const double apart = glm::length(across);
  if (!(apart > kApart * glm::length(a) * glm::length(b))) return glm::dmat3(0.0);
  const glm::dvec3 first = glm::normalize(a);
  const glm::dvec3 third = across / apart;
  return {first, glm::cross(third, first), third};
}

// The rotations that turn two landmarks into what became of them.
std::vector<glm::dmat3> possible_turns(const Coefficients& own, const Coefficients& told) {
  const Vectors before = landmarks(own);
  const Vectors after = landmarks(told);
  std::vector<glm::dmat3> turns;
  for (std::size_t i = 0; i < before.size(); ++i) {
    for (std::size_t j = i + 1; j < before.size(); ++j) {
      const glm::dmat3 from = basis_of(before[i], before[j]);
      const glm::dmat3 to = basis_of(after[i], after[j]);
      if (from != glm::dmat3(0.0) && to != glm::dmat3(0.0)) {
        turns.push_back(to * glm::transpose(from));
      }
    }
  }
  return turns;
}

bool is_turned(const Coefficients& own, const glm::dmat3& turn, const Coefficients& told) {
  constexpr int kFirst = 2;  // what is wrong is nearly always found out here, at little cost
  if (told.degree > kFirst && !is_turned(truncate(own, kFirst), turn, truncate(told, kFirst))) {
    return false;
  }
  return explains(rotate(own, turn), told);
}

}  // namespace

std::optional<LightChange> find_light_change(const Coefficients& own, const Coefficients& told) {
  const int degree = std::min(own.degree, told.degree);
  if (degree < 1) return std::nullopt;
  const Coefficients before = truncate(own, degree);
  const Coefficients after = truncate(told, degree);
  if (explains(before, after)) return LightChange{};
  if (const auto colour = factors(before, after)) {
    const Coefficients lit = apply_matrix(before, *colour);
    if (explains(lit, after)) return LightChange{*colour, glm::dmat3(1.0)};
    for (const glm::dmat3& turn : possible_turns(lit, after)) {
      if (is_turned(lit, turn, after)) return LightChange{*colour, turn};
    }
  }
  const auto matrix = least_squares(before, after);
  if (matrix && explains(apply_matrix(before, *matrix), after)) {
    return LightChange{*matrix, glm::dmat3(1.0)};
  }
  return std::nullopt;
}

}  // namespace shoal::viz
