// Spherical-harmonic coefficients of an RGB function on the sphere, and what is linear in them.
#pragma once

#include <array>
#include <vector>

#include "sphere/conventions.h"

namespace shoal {

inline constexpr int kChannelCount = 3;  // R, G, B

struct Coefficients {
  int degree = 0;
  std::array<std::vector<double>, kChannelCount> channels;  // each ((degree+1)^2), index order

  Coefficients() : Coefficients(0) {}
  explicit Coefficients(int degree_in) : degree(degree_in) {
    for (auto& channel : channels) channel.assign(coefficient_count(degree), 0.0);
  }

  friend bool operator==(const Coefficients&, const Coefficients&) = default;
};

}  // namespace shoal
