#include "kernels/direction_moments.h"

#include <algorithm>
#include <array>
#include <utility>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "kernels/direction_moments.cpp"
#include <hwy/foreach_target.h>  // compiles this file once a target; must come before highway.h
#include <hwy/highway.h>

#include "kernels/dispatch.h"
#include "kernels/moment_sums-inl.h"
#include "kernels/sample_range-inl.h"

HWY_BEFORE_NAMESPACE();
namespace shoal::kernels::HWY_NAMESPACE {

// A segment of a row, in the first-level cache: what every degree and order goes through again.
// Padded with texels of no light to whole groups.
struct Block {
  const float* x;
  const float* y;
  const float* z;
  float* cosine;                           // Re (x + iy)^m
  float* sine;                             // Im (x + iy)^m
  std::array<float*, 2> legendre;          // Pbar_lm / sin^m of two degrees in turn
  std::array<float*, kMaxChannels> light;  // solid angle times sample
  std::array<float*, 3> padded;            // directions of a segment that ends within a group
  std::size_t size = 0;                    // whole groups

  static constexpr std::size_t kArrays = 4 + kMaxChannels + 3;

  explicit Block(float* memory) {
    const auto next = [&memory] { return std::exchange(memory, memory + kSegment); };
    cosine = next();
    sine = next();
    for (auto& values : legendre) values = next();
    for (auto& values : light) values = next();
    for (auto& values : padded) values = next();
  }
};

// The numbers themselves where they fill whole groups, otherwise a copy with zeros behind it.
const float* padded(const float* numbers, std::size_t count, std::size_t size, float* copy) {
  if (count == size) return numbers;
  std::copy_n(numbers, count, copy);
  std::fill(copy + count, copy + size, 0.0F);
  return copy;
}

void load_directions(const TexelDirections& directions, std::size_t begin, std::size_t end,
                     Block& block) {
  const std::size_t count = end - begin;
  block.size = (count + kVirtualLanes - 1) / kVirtualLanes * kVirtualLanes;
  block.x = padded(directions.x + begin, count, block.size, block.padded[0]);
  block.y = padded(directions.y + begin, count, block.size, block.padded[1]);
  block.z = padded(directions.z + begin, count, block.size, block.padded[2]);
}

template <typename Samples>
void load_light(const Samples& samples, const float* solid_angles, std::size_t begin,
                std::size_t end, float* light, RunningRange& range) {
  const FloatTag tag;
  RangeTracker tracker(range);
  std::size_t k = begin;
  for (; k + kLanes <= end; k += kLanes) {
    const FloatVec v = samples.vector(k);
    tracker.see(v);
    hn::Store(hn::Mul(v, hn::LoadU(tag, solid_angles + k)), tag, light + (k - begin));
  }
  tracker.store();
  for (; k < end; ++k) {
    const float v = samples.one(k);
    range.see_one(v);
    light[k - begin] = v * solid_angles[k];
  }
  for (k -= begin; k % kVirtualLanes != 0; ++k) light[k] = 0.0F;
}

// (x + iy)^(m+1) from (x + iy)^m.
void next_order(const Block& block) {
  const FloatTag tag;
  for (std::size_t k = 0; k < block.size; k += kLanes) {
    const auto x = hn::LoadU(tag, block.x + k);
    const auto y = hn::LoadU(tag, block.y + k);
    const auto c = hn::Load(tag, block.cosine + k);
    const auto s = hn::Load(tag, block.sine + k);
    hn::Store(hn::Sub(hn::Mul(c, x), hn::Mul(s, y)), tag, block.cosine + k);
    hn::Store(hn::Add(hn::Mul(s, x), hn::Mul(c, y)), tag, block.sine + k);
  }
}

// Plain loops, of which the compiler makes register moves.
template <typename Terms>
HWY_INLINE void set_zero(typename Terms::Accumulators& sums) {
  for (int i = 0; i < Terms::kSums; ++i) {
    for (int c = 0; c < Terms::kChannels; ++c) sums[i][c] = hn::Zero(FloatTag());
  }
}

template <typename Terms>
HWY_INLINE void copy_sums(const typename Terms::Accumulators& from,
                          typename Terms::Accumulators& to) {
  for (int i = 0; i < Terms::kSums; ++i) {
    for (int c = 0; c < Terms::kChannels; ++c) to[i][c] = from[i][c];
  }
}

// sums[i][c * channel_stride] += what `terms` adds up over a segment. terms.add_run(begin, end,
// run) overwrites run[i][c] with the sums over groups from `begin` in one vector of the virtual
// lanes.
template <typename Terms>
void add_segment(const Terms& terms, std::size_t size,
                 const std::array<double*, Terms::kSums>& sums, std::ptrdiff_t channel_stride) {
  constexpr std::size_t kRun = kGroupsPerRun * kVirtualLanes;
  alignas(kAlignment) float totals[Terms::kSums][Terms::kChannels][kVirtualLanes];
  for (std::size_t lane = 0; lane < kVirtualLanes; lane += kLanes) {
    typename Terms::Accumulators runs[kRunsPerSegment];
    for (std::size_t r = 0; r < kRunsPerSegment; ++r) {
      const std::size_t begin = std::min(r * kRun, size);
      terms.add_run(begin + lane, std::min(begin + kRun, size), runs[r]);
    }
    for (int i = 0; i < Terms::kSums; ++i) {
      for (int c = 0; c < Terms::kChannels; ++c) {
        const auto total =
            hn::Add(hn::Add(runs[0][i][c], runs[1][i][c]), hn::Add(runs[2][i][c], runs[3][i][c]));
        hn::Store(total, FloatTag(), totals[i][c] + lane);
      }
    }
  }
  for (int i = 0; i < Terms::kSums; ++i) {
    for (int c = 0; c < Terms::kChannels; ++c) {
      sums[i][c * channel_stride] += reduce_lanes(totals[i][c]);
    }
  }
}

enum class Order { zero, other };

// One pair (l, m): steps the recurrence from l - 1 and l - 2 and adds up what both signs of m get.
template <Order kOrder, int kChannelCount>
struct PairTerms {
  static constexpr int kSums = kOrder == Order::zero ? 1 : 2;
  static constexpr int kChannels = kChannelCount;
  using Accumulators = FloatVec[kSums][kChannels];

  const Block& block;
  float near;
  float far;
  const float* below;  // at l - 1
  float* at;           // at l - 2 on the way in, at l on the way out

  HWY_INLINE void add_run(std::size_t begin, std::size_t end, Accumulators& run) const {
    const FloatTag tag;
    Accumulators sums;
    set_zero<PairTerms>(sums);
    const auto near_factor = hn::Set(tag, near);
    const auto far_factor = hn::Set(tag, far);
    for (std::size_t k = begin; k < end; k += kVirtualLanes) {
      const auto z = hn::LoadU(tag, block.z + k);
      const auto rise = hn::Mul(near_factor, hn::Mul(z, hn::Load(tag, below + k)));
      const auto legendre = hn::Sub(rise, hn::Mul(far_factor, hn::Load(tag, at + k)));
      hn::Store(legendre, tag, at + k);
      FloatVec basis[kSums];
      if constexpr (kOrder == Order::zero) {
        basis[0] = legendre;
      } else {
        basis[0] = hn::Mul(legendre, hn::Load(tag, block.cosine + k));
        basis[1] = hn::Mul(legendre, hn::Load(tag, block.sine + k));
      }
      for (int c = 0; c < kChannels; ++c) {
        const auto light = hn::Load(tag, block.light[c] + k);
        for (int t = 0; t < kSums; ++t) {
          sums[t][c] = hn::Add(sums[t][c], hn::Mul(light, basis[t]));
        }
      }
    }
    copy_sums<PairTerms>(sums, run);
  }
};

template <Order kOrder, int kChannels>
void add_order(const DirectionPlan& plan, int m, Block& block, double* sums) {
  // The step to l = m: near = 0 leaves minus far times the "value at m - 2", which is the constant.
  std::fill_n(block.legendre[0], block.size, -1.0F);
  std::fill_n(block.legendre[1], block.size, 0.0F);
  const std::size_t first = static_cast<std::size_t>(m) * (2 * plan.degree + 3 - m) / 2;
  for (int l = m; l <= plan.degree; ++l) {
    float* at = block.legendre[(l - m) % 2];
    float* below = block.legendre[(l - m + 1) % 2];
    const std::size_t index = first + (l - m);
    const PairTerms<kOrder, kChannels> pair{block, plan.near[index], plan.far[index], below, at};
    double* of_degree = sums + l * (l + 1);
    if constexpr (kOrder == Order::zero) {
      add_segment(pair, block.size, {of_degree}, plan.coefficient_count());
    } else {
      add_segment(pair, block.size, {of_degree + m, of_degree - m}, plan.coefficient_count());
    }
  }
}

template <int kChannels>
void add_orders(const DirectionPlan& plan, Block& block, double* sums) {
  std::fill_n(block.cosine, block.size, 1.0F);
  std::fill_n(block.sine, block.size, 0.0F);
  add_order<Order::zero, kChannels>(plan, 0, block, sums);
  for (int m = 1; m <= plan.degree; ++m) {
    next_order(block);
    add_order<Order::other, kChannels>(plan, m, block, sums);
  }
}

// All of degree 2 at once, in registers: the same operations in the same order, without storing
// anything between them (a third of the time).
template <int kChannelCount>
struct DegreeTwoTerms {
  static constexpr int kSums = 9;
  static constexpr int kChannels = kChannelCount;
  using Accumulators = FloatVec[kSums][kChannels];

  const DirectionPlan& plan;
  const Block& block;

  HWY_INLINE void add(int coefficient, FloatVec basis, std::size_t k, Accumulators& sums) const {
    for (int c = 0; c < kChannels; ++c) {
      const auto light = hn::Load(FloatTag(), block.light[c] + k);
      sums[coefficient][c] = hn::Add(sums[coefficient][c], hn::Mul(light, basis));
    }
  }

  HWY_INLINE FloatVec step(int index, FloatVec z, FloatVec below, FloatVec two_below) const {
    const FloatTag tag;
    const auto rise = hn::Mul(hn::Set(tag, plan.near[index]), hn::Mul(z, below));
    return hn::Sub(rise, hn::Mul(hn::Set(tag, plan.far[index]), two_below));
  }

  // Indices of the plan: (0,0) (1,0) (2,0), (1,1) (2,1), (2,2).
  HWY_INLINE void add_group(std::size_t k, Accumulators& sums) const {
    const FloatTag tag;
    const auto x = hn::LoadU(tag, block.x + k);
    const auto y = hn::LoadU(tag, block.y + k);
    const auto z = hn::LoadU(tag, block.z + k);
    const auto p00 = hn::Set(tag, plan.far[0]);
    const auto p10 = step(1, z, p00, hn::Zero(tag));
    add(0, p00, k, sums);
    add(2, p10, k, sums);
    add(6, step(2, z, p10, p00), k, sums);
    const auto p11 = hn::Set(tag, plan.far[3]);
    const auto p21 = step(4, z, p11, hn::Zero(tag));
    add(1, hn::Mul(p11, y), k, sums);
    add(3, hn::Mul(p11, x), k, sums);
    add(5, hn::Mul(p21, y), k, sums);
    add(7, hn::Mul(p21, x), k, sums);
    const auto p22 = hn::Set(tag, plan.far[5]);
    add(4, hn::Mul(p22, hn::Add(hn::Mul(y, x), hn::Mul(x, y))), k, sums);
    add(8, hn::Mul(p22, hn::Sub(hn::Mul(x, x), hn::Mul(y, y))), k, sums);
  }

  HWY_INLINE void add_run(std::size_t begin, std::size_t end, Accumulators& run) const {
    Accumulators sums;
    set_zero<DegreeTwoTerms>(sums);
    for (std::size_t k = begin; k < end; k += kVirtualLanes) add_group(k, sums);
    copy_sums<DegreeTwoTerms>(sums, run);
  }
};

template <int kChannels>
void add_all(const DirectionPlan& plan, Block& block, double* sums) {
  if (plan.degree != 2) return add_orders<kChannels>(plan, block, sums);
  std::array<double*, 9> all;
  for (int i = 0; i < 9; ++i) all[i] = sums + i;
  add_segment(DegreeTwoTerms<kChannels>{plan, block}, block.size, all, 9);
}

void DirectionMoments(const DirectionPlan& plan, const RowBand& band, int row,
                      const TexelDirections& directions, DirectionScratch& scratch,
                      std::span<double> sums, std::span<SampleRange> ranges) {
  const auto width = static_cast<std::size_t>(band.width);
  std::ranges::fill(sums, 0.0);
  scratch.block.resize_uninitialised(Block::kArrays * kSegment);
  Block block(scratch.block.data());
  prepare_scales(band, row, scratch.scales);
  std::array<RunningRange, kMaxChannels> running;
  for (std::size_t begin = 0; begin < width; begin += kSegment) {
    const std::size_t end = std::min(begin + kSegment, width);
    load_directions(directions, begin, end, block);
    for (int c = 0; c < band.channel_count; ++c) {
      with_samples(band, row, c, scratch.scales.data(), [&](const auto& samples) {
        load_light(samples, directions.solid_angle, begin, end, block.light[c], running[c]);
      });
    }
    const auto add = band.channel_count == 1 ? add_all<1> : add_all<kMaxChannels>;
    add(plan, block, sums.data());
  }
  for (int c = 0; c < band.channel_count; ++c) {
    with_samples(band, row, c, scratch.scales.data(), [&](const auto& samples) {
      ranges[c] = reduce_range(running[c], samples, width);
    });
  }
}

}  // namespace shoal::kernels::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
#include <cmath>
#include <numbers>

namespace shoal::kernels {

SHOAL_KERNEL_TABLE(DirectionMoments);

// The recurrence of sphere/legendre.cpp, divided by sin^m.
DirectionPlan make_direction_plan(int degree) {
  DirectionPlan plan;
  plan.degree = degree;
  const auto a = [](int l, int m) {
    return std::sqrt(static_cast<long double>(4 * l * l - 1) / (l * l - m * m));
  };
  long double sectoral = std::sqrt(std::numbers::inv_pi_v<long double> / 4);
  for (int m = 0; m <= degree; ++m) {
    if (m > 0) sectoral *= std::sqrt((m == 1 ? 2.0L : 1.0L) * (2 * m + 1) / (2 * m));
    for (int l = m; l <= degree; ++l) {
      const long double near = l == m ? 0.0L : a(l, m);
      const long double far = l == m ? sectoral : l == m + 1 ? 0.0L : a(l, m) / a(l - 1, m);
      plan.near.push_back(static_cast<float>(near));
      plan.far.push_back(static_cast<float>(far));
    }
  }
  return plan;
}

void direction_moments(const DirectionPlan& plan, const RowBand& band, int row,
                       const TexelDirections& directions, DirectionScratch& scratch,
                       std::span<double> sums, std::span<SampleRange> ranges) {
  SHOAL_CALL_KERNEL(DirectionMoments)(plan, band, row, directions, scratch, sums, ranges);
}

}  // namespace shoal::kernels
#endif
