// The four-fold symmetry of a row's columns. Included once a SIMD target.
#if defined(SHOAL_KERNELS_ROW_FOLD_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef SHOAL_KERNELS_ROW_FOLD_INL_H_
#undef SHOAL_KERNELS_ROW_FOLD_INL_H_
#else
#define SHOAL_KERNELS_ROW_FOLD_INL_H_
#endif

#include "kernels/sample_range-inl.h"

HWY_BEFORE_NAMESPACE();
namespace shoal::kernels::HWY_NAMESPACE {

HWY_INLINE FloatVec reversed(FloatVec v) { return hn::Reverse(FloatTag(), v); }

HWY_INLINE float reversed(float v) { return v; }

// The four columns k, W/2-1-k, W/2+k, W-1-k lie at phi, pi - phi, pi + phi, -phi, where cos(m .)
// and sin(m .) are the same but for signs that depend on the parity of m. Their signed sums are the
// streams that cosines of even m, cosines of odd m, sines of even m and sines of odd m are
// multiplied with.
template <typename V>
struct Fourfold {
  V even_cosine, odd_cosine, even_sine, odd_sine;
};

template <typename V, typename AddOp, typename SubOp>
HWY_INLINE Fourfold<V> fold(V a, V b, V c, V d, AddOp add, SubOp sub) {
  const V near_sum = add(a, d);
  const V far_sum = add(b, c);
  const V near_difference = sub(a, d);
  const V far_difference = sub(c, b);
  return {add(near_sum, far_sum), sub(near_sum, far_sum), add(near_difference, far_difference),
          sub(near_difference, far_difference)};
}

// Columns k to k + kLanes of the first quarter with their partners.
template <typename Samples>
HWY_INLINE Fourfold<FloatVec> fold_columns(const Samples& samples, std::size_t width, std::size_t k,
                                           RangeTracker& tracker) {
  const auto add = [](FloatVec x, FloatVec y) { return hn::Add(x, y); };
  const auto sub = [](FloatVec x, FloatVec y) { return hn::Sub(x, y); };
  const std::size_t half = width / 2;
  const FloatVec a = samples.vector(k);
  const FloatVec b = samples.vector(half - k - kLanes);
  const FloatVec c = samples.vector(half + k);
  const FloatVec d = samples.vector(width - k - kLanes);
  tracker.see(a);
  tracker.see(b);
  tracker.see(c);
  tracker.see(d);
  return fold(a, reversed(b), c, reversed(d), add, sub);
}

}  // namespace shoal::kernels::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // include guard, toggled once a target
