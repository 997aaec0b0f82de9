// How products are added up to moments: the order that makes the bits. Included once a SIMD target.
//
// Sixteen virtual lanes; groups of 16 columns; up to 8 groups are added in a row in single
// precision, the four such runs of a segment pairwise; segments are carried to double. That keeps
// the longest chain of single-precision additions short without any cost in speed.
#if defined(SHOAL_KERNELS_MOMENT_SUMS_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef SHOAL_KERNELS_MOMENT_SUMS_INL_H_
#undef SHOAL_KERNELS_MOMENT_SUMS_INL_H_
#else
#define SHOAL_KERNELS_MOMENT_SUMS_INL_H_
#endif

#include "kernels/samples-inl.h"

HWY_BEFORE_NAMESPACE();
namespace shoal::kernels::HWY_NAMESPACE {

// A segment's streams, four a channel, stay in the first-level cache.
inline constexpr std::size_t kSegment = 512;
inline constexpr std::size_t kGroupsPerRun = 8;
inline constexpr std::size_t kRunsPerSegment = 4;

// sums[i] += segment[i], in double.
HWY_INLINE void carry(FloatVec segment, double* sums) {
  const HWY_CAPPED(double, kVirtualLanes) d;
  const hn::Rebind<float, decltype(d)> narrow;
  alignas(kAlignment) float lanes[kLanes];
  hn::Store(segment, FloatTag(), lanes);
  for (std::size_t i = 0; i < kLanes; i += hn::Lanes(d)) {
    const auto wide = hn::PromoteTo(d, hn::Load(narrow, lanes + i));
    hn::Store(hn::Add(hn::Load(d, sums + i), wide), d, sums + i);
  }
}

// The fixed tree over the virtual lanes, in double: halves are added until one is left.
HWY_INLINE double reduce_eight(const double* eight) {
  const HWY_CAPPED(double, 4) d;
  alignas(kAlignment) double four[4];
  for (std::size_t i = 0; i < 4; i += hn::Lanes(d)) {
    hn::Store(hn::Add(hn::Load(d, eight + i), hn::Load(d, eight + 4 + i)), d, four + i);
  }
  return (four[0] + four[2]) + (four[1] + four[3]);
}

HWY_INLINE double reduce_lanes(const double* lanes) {
  const HWY_CAPPED(double, 8) d;
  alignas(kAlignment) double eight[8];
  for (std::size_t i = 0; i < 8; i += hn::Lanes(d)) {
    hn::Store(hn::Add(hn::Load(d, lanes + i), hn::Load(d, lanes + 8 + i)), d, eight + i);
  }
  return reduce_eight(eight);
}

HWY_INLINE double reduce_lanes(const float* lanes) {
  const HWY_CAPPED(double, 8) d;
  const hn::Rebind<float, decltype(d)> narrow;
  alignas(kAlignment) double eight[8];
  for (std::size_t i = 0; i < 8; i += hn::Lanes(d)) {
    const auto low = hn::PromoteTo(d, hn::Load(narrow, lanes + i));
    const auto high = hn::PromoteTo(d, hn::Load(narrow, lanes + 8 + i));
    hn::Store(hn::Add(low, high), d, eight + i);
  }
  return reduce_eight(eight);
}

}  // namespace shoal::kernels::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // include guard, toggled once a target
