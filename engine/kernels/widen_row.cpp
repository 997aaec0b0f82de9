#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "kernels/widen_row.cpp"
#include <hwy/foreach_target.h>  // compiles this file once a target; must come before highway.h
#include <hwy/highway.h>

#include "kernels/dispatch.h"
#include "kernels/row_moments.h"
#include "kernels/samples-inl.h"

HWY_BEFORE_NAMESPACE();
namespace shoal::kernels::HWY_NAMESPACE {

void WidenRow(const RowBand& band, int row, int channel, RowMomentScratch& scratch, float* out) {
  prepare_scales(band, row, scratch.scales);
  with_samples(band, row, channel, scratch.scales.data(), [&](const auto& samples) {
    const auto width = static_cast<std::size_t>(band.width);
    std::size_t k = 0;
    for (; k + kLanes <= width; k += kLanes) hn::StoreU(samples.vector(k), FloatTag(), out + k);
    for (; k < width; ++k) out[k] = samples.one(k);
  });
}

}  // namespace shoal::kernels::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace shoal::kernels {

SHOAL_KERNEL_TABLE(WidenRow);

void widen_row(const RowBand& band, int row, int channel, RowMomentScratch& scratch, float* out) {
  SHOAL_CALL_KERNEL(WidenRow)(band, row, channel, scratch, out);
}

}  // namespace shoal::kernels
#endif
