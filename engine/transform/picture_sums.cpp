#include "transform/picture_sums.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

namespace shoal {
namespace {

// Samples as large as this could overflow a kernel's sums of up to 128 of them; such rows go
// through it scaled down by a power of two, which loses nothing beside values so large.
constexpr std::uint32_t kHugeMagnitudeBits = (112U + 127U) << 23;
constexpr float kHugeScale = 0x1p-16F;

// Texels that are looked at together: their largest samples as integers, whose order is that of
// floats above 0 and in which what is not finite is larger than those.
constexpr int kTogether = 32;

constexpr std::size_t kManyBright = 256;

std::int32_t largest_bits(const float* samples, int count) {
  std::int32_t largest = std::numeric_limits<std::int32_t>::min();
  for (int j = 0; j < count; ++j) {
    largest = std::max(largest, std::bit_cast<std::int32_t>(samples[j]));
  }
  return largest;
}

// A sample as the policy leaves it, but for the clamp.
float without_clamp(float sample, const PixelPolicy& policy) {
  if (!std::isfinite(sample)) return 0.0F;
  return policy.negative == PixelPolicy::Negative::zero ? std::max(sample, 0.0F) : sample;
}

}  // namespace

ScanlinePlace scanline_place(const PictureInfo& info, int scanline) {
  const bool reversed = info.samples_reversed;
  const int step = reversed ? -1 : 1;
  if (info.scan_axis == ScanAxis::rows) {
    return {scanline, reversed ? info.width - 1 : 0, 0, step};
  }
  return {reversed ? info.height - 1 : 0, scanline, step, 0};
}

void PictureSums::add(const RowBand& band, ProjectionWorker& worker) {
  add_rows(band, worker);
  hand_over(worker);
}

void PictureSums::hand_over(ProjectionWorker& worker) const {
  if (worker.bright.empty()) return;
  bright_->add(worker.bright);
  worker.bright.clear();
}

void PictureSums::look_at(const RowBand& band, int row, const ScanlinePlace& place,
                          std::span<const kernels::SampleRange> ranges,
                          ProjectionWorker& worker) const {
  if (bright_ == nullptr) return;
  // The first row of the picture that the scanline touches.
  const int top = place.row_step == 0 ? static_cast<int>(place.row) : 0;
  const bool is_dark = !ranges.empty() && std::ranges::none_of(ranges, [&](const auto& range) {
    return !range.finite() || bright_->may_hold(range.maximum, top);
  });
  if (is_dark) return;
  const auto width = static_cast<std::size_t>(band.width);
  worker.samples.resize_uninitialised(kMaxChannels * width);
  std::array<const float*, kMaxChannels> channels;
  for (int c = 0; c < kMaxChannels; ++c) {
    const int channel = std::min(c, band.channel_count - 1);
    float* samples = worker.samples.data() + channel * width;
    if (c == channel) kernels::widen_row(band, row, c, worker.scratch, samples);
    channels[c] = samples;
  }
  for (int begin = 0; begin < band.width; begin += kTogether) {
    const int end = std::min(begin + kTogether, band.width);
    std::int32_t largest = 0;
    for (int c = 0; c < band.channel_count; ++c) {
      largest = std::max(largest, largest_bits(channels[c] + begin, end - begin));
    }
    const auto value = std::bit_cast<float>(largest);
    if (std::isfinite(value) && !bright_->may_hold(value, top)) continue;
    for (int j = begin; j < end; ++j) {
      BrightTexel texel{static_cast<std::int32_t>(place.row) + j * place.row_step,
                        static_cast<std::int32_t>(place.column) + j * place.column_step,
                        {}};
      for (int c = 0; c < kMaxChannels; ++c) {
        texel.samples[c] = without_clamp(channels[c][j], settings_.pixels);
      }
      if (bright_->may_hold(texel.value(), texel.row)) worker.bright.push_back(texel);
    }
  }
  // The sooner these are known, the fewer of the next rows are.
  if (worker.bright.size() >= kManyBright) hand_over(worker);
}

bool PictureSums::needs_policy(std::span<const kernels::SampleRange> ranges) const {
  const double clamp = settings_.pixels.clamp;
  return std::ranges::any_of(ranges, [&](const kernels::SampleRange& range) {
    return !range.finite() || range.minimum < 0.0F || (clamp > 0.0 && range.maximum > clamp) ||
           range.magnitude_bits >= kHugeMagnitudeBits;
  });
}

PolicyRow PictureSums::treat(const RowBand& band, int row, const ScanlinePlace& place,
                             const OnClamp& on_clamp, ProjectionWorker& worker) const {
  const auto width = static_cast<std::size_t>(band.width);
  worker.samples.resize_uninitialised(kMaxChannels * width);
  PolicyRow treated;
  treated.channel_count = band.channel_count;
  for (int c = 0; c < band.channel_count; ++c) {
    treated.channels[c] = worker.samples.span().subspan(c * width, width);
    kernels::widen_row(band, row, c, worker.scratch, treated.channels[c].data());
  }
  apply_pixel_policy(settings_.pixels, treated, place, worker.tally, on_clamp);
  return treated;
}

PictureSums::TreatedBand PictureSums::treat_for_kernel(const RowBand& band, int row,
                                                       const ScanlinePlace& place,
                                                       std::span<const kernels::SampleRange> ranges,
                                                       const OnClamp& on_clamp,
                                                       ProjectionWorker& worker) const {
  // A channel that is not finite may hide huge samples among those that are.
  const bool may_be_huge = std::ranges::any_of(
      ranges, [](const auto& range) { return range.magnitude_bits >= kHugeMagnitudeBits; });
  const float scale = may_be_huge ? kHugeScale : 1.0F;
  const PolicyRow treated = treat(band, row, place, on_clamp, worker);
  TreatedBand result{{0, 1, band.width, band.channel_count, {}, {}}, scale};
  for (int c = 0; c < band.channel_count; ++c) {
    for (float& sample : treated.channels[c]) sample *= scale;
    result.band.channels[c] = {std::as_bytes(treated.channels[c]).data(), 0, SampleType::float32};
  }
  return result;
}

}  // namespace shoal
