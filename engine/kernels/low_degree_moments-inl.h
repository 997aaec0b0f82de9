// Moments of low degree without leaving the registers. Included once a SIMD target.
//
// Storing the folded columns, to load them again for every order, takes more time than the sums of
// degree 2. Here a channel's sums of all orders advance together, column group by column group.
#if defined(SHOAL_KERNELS_LOW_DEGREE_MOMENTS_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef SHOAL_KERNELS_LOW_DEGREE_MOMENTS_INL_H_
#undef SHOAL_KERNELS_LOW_DEGREE_MOMENTS_INL_H_
#else
#define SHOAL_KERNELS_LOW_DEGREE_MOMENTS_INL_H_
#endif

#include "kernels/moment_sums-inl.h"
#include "kernels/row_fold-inl.h"

HWY_BEFORE_NAMESPACE();
namespace shoal::kernels::HWY_NAMESPACE {

template <int kDegree>
struct LowDegree {
  static constexpr int kMoments = 2 * kDegree + 1;
  using Sums = FloatVec[kMoments];

  const RowMomentPlan& plan;

  // Adds the folded columns at `k` to the sums of every order.
  HWY_INLINE void add_columns(const Fourfold<FloatVec>& f, std::size_t k, Sums& run) const {
    const FloatTag tag;
    run[0] = hn::Add(run[0], f.even_cosine);  // cos(0 phi) = 1
    for (int m = 1; m <= kDegree; ++m) {
      const auto cosine = hn::Load(tag, plan.cosines.data() + m * plan.padded_length + k);
      const auto sine = hn::Load(tag, plan.sines.data() + m * plan.padded_length + k);
      const FloatVec to_cosine = m % 2 == 0 ? f.even_cosine : f.odd_cosine;
      const FloatVec to_sine = m % 2 == 0 ? f.even_sine : f.odd_sine;
      run[m] = hn::Add(run[m], hn::Mul(to_cosine, cosine));
      run[kDegree + m] = hn::Add(run[kDegree + m], hn::Mul(to_sine, sine));
    }
  }

  template <typename Samples>
  HWY_INLINE void add_run(const Samples& samples, std::size_t begin, std::size_t end, Sums& run,
                          RangeTracker& tracker) const {
    Sums sums;
    for (auto& sum : sums) sum = hn::Zero(FloatTag());
    for (std::size_t k = begin; k < end; k += kVirtualLanes) {
      const auto width = static_cast<std::size_t>(plan.width);
      add_columns(fold_columns(samples, width, k, tracker), k, sums);
    }
    for (int i = 0; i < kMoments; ++i) run[i] = sums[i];
  }

  // sums: (2L+1, 16), to which the row is added.
  template <typename Samples>
  void add_row(const Samples& samples, double* sums, RunningRange& range) const {
    RangeTracker tracker(range);
    constexpr std::size_t kRun = kGroupsPerRun * kVirtualLanes;
    for (std::size_t segment = 0; segment < plan.stream_length; segment += kSegment) {
      for (std::size_t lane = 0; lane < kVirtualLanes; lane += kLanes) {
        Sums runs[kRunsPerSegment];
        for (std::size_t r = 0; r < kRunsPerSegment; ++r) {
          const std::size_t begin = std::min(segment + r * kRun, plan.stream_length);
          const std::size_t end = std::min(begin + kRun, plan.stream_length);
          add_run(samples, begin + lane, end, runs[r], tracker);
        }
        for (int i = 0; i < kMoments; ++i) {
          const FloatVec total =
              hn::Add(hn::Add(runs[0][i], runs[1][i]), hn::Add(runs[2][i], runs[3][i]));
          carry(total, sums + i * kVirtualLanes + lane);
        }
      }
    }
    tracker.store();
  }
};

// Whole groups only: the columns of the last group need no padding.
inline bool fits_registers(const RowMomentPlan& plan) {
  return plan.symmetry == Symmetry::four_fold && plan.stream_length % kVirtualLanes == 0 &&
         plan.degree >= 2 && plan.degree <= 4;
}

template <typename Samples>
void low_degree_moments(const RowMomentPlan& plan, const Samples& samples, double* sums,
                        RunningRange& range) {
  switch (plan.degree) {
    case 2:
      return LowDegree<2>{plan}.add_row(samples, sums, range);
    case 3:
      return LowDegree<3>{plan}.add_row(samples, sums, range);
    default:
      return LowDegree<4>{plan}.add_row(samples, sums, range);
  }
}

}  // namespace shoal::kernels::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // include guard, toggled once a target
