// Reproducible numbers for tests: from raw engine bits, since the standard's distributions differ
// from library to library.
#pragma once

#include <cstdint>
#include <random>

namespace shoal::test {

class RandomNumbers {
 public:
  explicit RandomNumbers(std::uint64_t seed) : engine_(seed) {}

  std::uint64_t bits() { return engine_(); }
  // In [0, bound).
  int below(int bound) { return static_cast<int>(bits() % static_cast<std::uint64_t>(bound)); }
  // In [0, 1).
  double unit() { return static_cast<double>(bits() >> 11) * 0x1p-53; }
  // In [low, high).
  double between(double low, double high) { return low + (high - low) * unit(); }

 private:
  std::mt19937_64 engine_;
};

}  // namespace shoal::test
