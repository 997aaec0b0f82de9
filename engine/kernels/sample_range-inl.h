// The extremes of a row of samples. Included once a SIMD target.
#if defined(SHOAL_KERNELS_SAMPLE_RANGE_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef SHOAL_KERNELS_SAMPLE_RANGE_INL_H_
#undef SHOAL_KERNELS_SAMPLE_RANGE_INL_H_
#else
#define SHOAL_KERNELS_SAMPLE_RANGE_INL_H_
#endif

#include <algorithm>
#include <array>
#include <bit>
#include <limits>

#include "kernels/row_moments.h"
#include "kernels/samples-inl.h"

HWY_BEFORE_NAMESPACE();
namespace shoal::kernels::HWY_NAMESPACE {

// The running extremes of a row, one a virtual lane, as float bits compared as integers: in that
// order of samples that are not negative a NaN or an infinity is larger than every finite number,
// and whatever has its sign bit set is smaller than zero.
struct RunningRange {
  alignas(kAlignment) std::array<std::int32_t, kVirtualLanes> smallest;
  alignas(kAlignment) std::array<std::int32_t, kVirtualLanes> largest;

  RunningRange() {
    smallest.fill(std::numeric_limits<std::int32_t>::max());
    largest.fill(0);
  }
  void see_one(float value) {
    const auto bits = std::bit_cast<std::int32_t>(value);
    smallest[0] = std::min(smallest[0], bits);
    largest[0] = std::max(largest[0], bits);
  }
};

// A running range in registers.
class RangeTracker {
 public:
  explicit RangeTracker(RunningRange& range)
      : range_(range),
        smallest_(hn::Load(IntTag(), range.smallest.data())),
        largest_(hn::Load(IntTag(), range.largest.data())) {}

  HWY_INLINE void see(FloatVec v) {
    const auto bits = hn::BitCast(IntTag(), v);
    smallest_ = hn::Min(smallest_, bits);
    largest_ = hn::Max(largest_, bits);
  }
  HWY_INLINE void store() {
    hn::Store(smallest_, IntTag(), range_.smallest.data());
    hn::Store(largest_, IntTag(), range_.largest.data());
  }

 private:
  RunningRange& range_;
  hn::Vec<IntTag> smallest_;
  hn::Vec<IntTag> largest_;
};

// The range of a row some of whose samples have the sign bit set.
template <typename Samples>
SampleRange signed_range(const Samples& samples, std::size_t width) {
  SampleRange range{std::numeric_limits<float>::infinity(), -std::numeric_limits<float>::infinity(),
                    0};
  alignas(kAlignment) std::array<float, kVirtualLanes> values;
  const auto see = [&](float value) {
    range.minimum = std::min(range.minimum, value);
    range.maximum = std::max(range.maximum, value);
    range.magnitude_bits =
        std::max(range.magnitude_bits, std::bit_cast<std::uint32_t>(value) & 0x7FFFFFFFU);
  };
  std::size_t k = 0;
  for (; k + kLanes <= width; k += kLanes) {
    hn::Store(samples.vector(k), FloatTag(), values.data());
    std::for_each_n(values.begin(), kLanes, see);
  }
  for (; k < width; ++k) see(samples.one(k));
  return range;
}

template <typename Samples>
SampleRange reduce_range(const RunningRange& running, const Samples& samples, std::size_t width) {
  const std::int32_t smallest = std::ranges::min(running.smallest);
  const std::int32_t largest = std::ranges::max(running.largest);
  if (smallest < 0) return signed_range(samples, width);
  return {std::bit_cast<float>(smallest), std::bit_cast<float>(largest),
          static_cast<std::uint32_t>(largest)};
}

}  // namespace shoal::kernels::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // include guard, toggled once a target
