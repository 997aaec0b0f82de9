// The brightest texels of a picture, kept while its rows are projected: for what is known only
// after all of it has been seen, and would need it decoded once more.
//
// A texel's value is its largest channel, in the file's own samples: those and only those texels
// that a clamp changes have a value above it; the largest channel of a row is known before any of
// its texels is looked at; and it needs no colour space.
//
// Kept are the texels brighter than all but a fraction of the sphere's solid angle. They are a
// function of the picture alone: texels are ordered by value, then row, then column, and one is
// let go only when those before it cover more than the fraction by themselves, whoever saw them. A
// histogram of values tells that at once; only the last ones are sorted.
//
// Memory: 20 bytes a texel of up to twice the fraction of the sphere while rows come, 56 bytes a
// texel of the fraction itself while they are sorted at the end, and 256 kB. At the largest
// fraction, 0.01, that is 0.6 bytes for each texel of an equirect picture where the light is near
// the equator. Where it is at both poles, whose texels are small, two caps of 0.005 of the sphere
// hold 2/pi acos(0.99) = 0.09 of the rows: 5 bytes for each texel.
#pragma once

#include <algorithm>
#include <array>
#include <atomic>
#include <bit>
#include <cstdint>
#include <functional>
#include <limits>
#include <mutex>
#include <span>
#include <vector>

#include "core/row_band.h"

namespace shoal {

struct BrightTexel {
  std::int32_t row = 0;  // of the picture
  std::int32_t column = 0;
  std::array<float, kMaxChannels> samples{};  // finite; all alike in a grey picture

  [[nodiscard]] float value() const { return std::ranges::max(samples); }
  friend bool operator==(const BrightTexel&, const BrightTexel&) = default;
};

// Texels brightest first, with what they cover.
struct BrightestTexels {
  std::vector<BrightTexel> texels;
  std::vector<double> solid_angles;  // of each

  // The value above which at most `fraction` of the sphere lies: that of the first texel that,
  // together with all before it, covers more. 0 where the kept ones do not cover that much: then
  // less than that of the picture is above the floor. Precondition: fraction <= the one kept by.
  [[nodiscard]] float threshold(double fraction) const;
};

inline constexpr double kMostBright = 0.01;

class BrightTexels {
 public:
  using SolidAngle = std::function<double(int row, int column)>;

  // Texels up to `floor` are never kept. Preconditions: 0 < fraction <= kMostBright; floor >= 0.
  BrightTexels(double fraction, float floor, SolidAngle solid_angle);

  // Whether a row with such a largest sample may hold any. `row` is the first that it touches.
  [[nodiscard]] bool may_hold(float largest, int row) const {
    return largest > floor_ && key(largest, row) >= cut_.load(std::memory_order_relaxed);
  }

  // Takes the texels that workers have gathered, in any order.
  void add(std::span<const BrightTexel> texels);

  // After all rows.
  [[nodiscard]] BrightestTexels brightest();

 private:
  // Greater for a brighter texel, then for one of a higher row. Bits of positive floats are in
  // their order.
  static std::uint64_t key(float value, int row) {
    return std::uint64_t{std::bit_cast<std::uint32_t>(value)} << 32 |
           (std::numeric_limits<std::uint32_t>::max() - static_cast<std::uint32_t>(row));
  }

  void raise_cut();
  void let_go();
  void keep_first(double most);

  const double most_;  // sr
  const float floor_;
  const SolidAngle solid_angle_;
  std::atomic<std::uint64_t> cut_{0};  // texels whose key is below have been let go
  std::mutex mutex_;                   // guards what follows
  std::vector<BrightTexel> texels_;
  std::size_t count_to_let_go_at_;
  std::vector<double>
      covered_by_bin_;         // sr: of all texels seen, by the leading bits of their value
  std::uint32_t cut_bin_ = 0;  // what is below has been let go
  double covered_ = 0.0;       // by the bins from there on
};

}  // namespace shoal
