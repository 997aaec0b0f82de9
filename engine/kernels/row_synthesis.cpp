#include <algorithm>

#include "kernels/row_moments.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "kernels/row_synthesis.cpp"
#include <hwy/foreach_target.h>  // compiles this file once a target; must come before highway.h
#include <hwy/highway.h>

#include "kernels/dispatch.h"
#include "kernels/samples-inl.h"

HWY_BEFORE_NAMESPACE();
namespace shoal::kernels::HWY_NAMESPACE {

// One vector of a synthesised row: the sum over the orders of the given parity (or all, with step
// 1).
HWY_INLINE void synthesise_orders(const RowMomentPlan& plan, const float* moments, int first_order,
                                  int step, std::size_t at, FloatVec& cosine_sum,
                                  FloatVec& sine_sum) {
  const FloatTag tag;
  cosine_sum = hn::Zero(tag);
  sine_sum = hn::Zero(tag);
  for (int m = first_order; m <= plan.degree; m += step) {
    const FloatVec cosine = hn::Load(tag, plan.cosines.data() + m * plan.padded_length + at);
    cosine_sum = hn::Add(cosine_sum, hn::Mul(hn::Set(tag, moments[m]), cosine));
    if (m == 0) continue;
    const FloatVec sine = hn::Load(tag, plan.sines.data() + m * plan.padded_length + at);
    sine_sum = hn::Add(sine_sum, hn::Mul(hn::Set(tag, moments[plan.degree + m]), sine));
  }
}

void SynthesiseRow(const RowMomentPlan& plan, const float* moments, float* out) {
  const FloatTag tag;
  const std::size_t width = static_cast<std::size_t>(plan.width);
  alignas(kAlignment) float block[4][kVirtualLanes];
  for (std::size_t at = 0; at < plan.stream_length; at += kLanes) {
    const std::size_t count = std::min(kLanes, plan.stream_length - at);
    FloatVec ec;
    FloatVec es;
    if (plan.symmetry == Symmetry::none) {
      synthesise_orders(plan, moments, 0, 1, at, ec, es);
      hn::Store(hn::Add(ec, es), tag, block[0]);
      std::copy_n(block[0], count, out + at);
      continue;
    }
    FloatVec oc;
    FloatVec os;
    synthesise_orders(plan, moments, 0, 2, at, ec, es);
    synthesise_orders(plan, moments, 1, 2, at, oc, os);
    hn::Store(hn::Add(hn::Add(ec, oc), hn::Add(es, os)), tag, block[0]);
    hn::Store(hn::Add(hn::Sub(ec, oc), hn::Sub(os, es)), tag, block[1]);
    hn::Store(hn::Add(hn::Sub(ec, oc), hn::Sub(es, os)), tag, block[2]);
    hn::Store(hn::Sub(hn::Add(ec, oc), hn::Add(es, os)), tag, block[3]);
    std::copy_n(block[0], count, out + at);
    std::reverse_copy(block[1], block[1] + count, out + width / 2 - at - count);
    std::copy_n(block[2], count, out + width / 2 + at);
    std::reverse_copy(block[3], block[3] + count, out + width - at - count);
  }
}

}  // namespace shoal::kernels::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace shoal::kernels {

SHOAL_KERNEL_TABLE(SynthesiseRow);

void synthesise_row(const RowMomentPlan& plan, std::span<const double> moments,
                    RowMomentScratch& scratch, float* out) {
  scratch.streams.resize_uninitialised(moments.size());
  std::ranges::transform(moments, scratch.streams.data(),
                         [](double moment) { return static_cast<float>(moment); });
  SHOAL_CALL_KERNEL(SynthesiseRow)(plan, scratch.streams.data(), out);
}

}  // namespace shoal::kernels
#endif
