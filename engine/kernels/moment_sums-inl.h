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

// The fixed tree over the virtual lanes: halves are added until one is left.
HWY_INLINE double reduce_lanes(const double* lanes) {
  double eight[8];
  for (int i = 0; i < 8; ++i) eight[i] = lanes[i] + lanes[i + 8];
  double four[4];
  for (int i = 0; i < 4; ++i) four[i] = eight[i] + eight[i + 4];
  return (four[0] + four[2]) + (four[1] + four[3]);
}

}  // namespace shoal::kernels::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // include guard, toggled once a target
