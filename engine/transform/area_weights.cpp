#include "transform/area_weights.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>

namespace shoal {
namespace {

// The axis in units of which both grids' edges are whole numbers.
class Axis {
 public:
  Axis(int count, int small, Sampling sampling)
      : count_(count), small_(small), endpoints_(sampling == Sampling::endpoints && count > 1) {}

  [[nodiscard]] std::int64_t length() const { return cells() * small_; }
  [[nodiscard]] std::int64_t small_edge(int texel) const { return cells() * texel; }
  [[nodiscard]] std::int64_t edge(int texel) const {
    if (!endpoints_) return static_cast<std::int64_t>(texel) * small_;
    return std::clamp<std::int64_t>(2 * std::int64_t{texel} - 1, 0, cells()) * small_;
  }

 private:
  [[nodiscard]] std::int64_t cells() const {
    return endpoints_ ? 2 * (std::int64_t{count_} - 1) : count_;
  }

  int count_;
  int small_;
  bool endpoints_;
};

// `measure(a, b)` is the size of what lies between two places of the axis, 0 where b <= a.
template <typename Measure>
std::vector<AreaShare> shares(int count, int small, const Axis& axis, const Measure& measure) {
  std::vector<AreaShare> shares(static_cast<std::size_t>(count));
  int first = 0;
  for (int i = 0; i < count; ++i) {
    const std::int64_t begin = axis.edge(i);
    const std::int64_t end = axis.edge(i + 1);
    while (axis.small_edge(first + 1) <= begin && first + 1 < small) ++first;
    const auto share_in = [&](int texel) {
      const std::int64_t low = axis.small_edge(texel);
      const std::int64_t high = axis.small_edge(texel + 1);
      const std::int64_t from = std::max(begin, low);
      const std::int64_t to = std::min(end, high);
      return to <= from ? 0.0F : static_cast<float>(measure(from, to) / measure(low, high));
    };
    shares[i] = {first, share_in(first), first + 1 < small ? share_in(first + 1) : 0.0F};
  }
  return shares;
}

}  // namespace

std::vector<AreaShare> column_shares(int count, int small, Sampling sampling) {
  const auto length = [](std::int64_t from, std::int64_t to) {
    return static_cast<double>(to - from);
  };
  return shares(count, small, Axis(count, small, sampling), length);
}

std::vector<AreaShare> row_shares(int count, int small, Sampling sampling) {
  const Axis axis(count, small, sampling);
  const double unit = std::numbers::pi / static_cast<double>(axis.length());
  // cos(a) - cos(b), but without the loss of digits near the poles.
  const auto solid_angle = [&](std::int64_t from, std::int64_t to) {
    return 2.0 * std::sin(0.5 * unit * static_cast<double>(from + to)) *
           std::sin(0.5 * unit * static_cast<double>(to - from));
  };
  return shares(count, small, axis, solid_angle);
}

}  // namespace shoal
