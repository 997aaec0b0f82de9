#include "transform/scanline_means.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace shoal {
namespace {

// Scanlines summed in single precision: with 2^-24 for each product and each sum, (32 + 2) u.
constexpr int kMaxSummedScanlines = 32;

// Of all weights of scanlines, so that sums of the largest floats are floats still, although
// weights sum to 1 but for rounding. Divided out with the weights.
constexpr float kHeadroom = 0.5F;

void add_scaled(std::span<const float> from, float weight, std::span<float> to) {
  const float* in = from.data();
  float* out = to.data();
  for (std::size_t i = 0; i < to.size(); ++i) out[i] += weight * in[i];
}

bool all_finite(std::span<const float> samples) {
  // Without a branch, so that the compiler makes it SIMD: 0 * x is NaN for what is not finite.
  float sum = 0.0F;
  constexpr std::size_t kLanes = 16;
  std::array<float, kLanes> lanes{};
  std::size_t i = 0;
  for (; i + kLanes <= samples.size(); i += kLanes) {
    for (std::size_t k = 0; k < kLanes; ++k) lanes[k] += 0.0F * samples[i + k];
  }
  for (; i < samples.size(); ++i) sum += 0.0F * samples[i];
  for (const float lane : lanes) sum += lane;
  return sum == 0.0F;
}

bool can_be_non_finite(const RowBand& band) {
  return std::any_of(band.channels.begin(), band.channels.begin() + band.channel_count,
                     [](const Plane& plane) {
                       return plane.type == SampleType::half || plane.type == SampleType::float32;
                     });
}

}  // namespace

void read_scanline(const RowBand& band, int row, kernels::RowMomentScratch& scratch,
                   Scanline& scanline) {
  const auto count = static_cast<std::size_t>(band.width);
  scanline.samples.resize_uninitialised(count * band.channel_count);
  scanline.present.clear();
  const std::span<float> samples = scanline.samples.span();
  for (int c = 0; c < band.channel_count; ++c) {
    kernels::widen_row(band, row, c, scratch, samples.data() + c * count);
  }
  if (!can_be_non_finite(band) || all_finite(samples)) return;
  scanline.present.assign(count, 1.0F);
  for (std::size_t i = 0; i < samples.size(); ++i) {
    if (!std::isfinite(samples[i])) scanline.present[i % count] = 0.0F;
  }
  for (std::size_t i = 0; i < samples.size(); ++i) {
    if (scanline.present[i % count] == 0.0F) samples[i] = 0.0F;
  }
}

void keep_only(int begin, int end, int width, Scanline& scanline) {
  if (begin <= 0 && end >= width) return;
  scanline.present.resize(width, 1.0F);
  std::fill(scanline.present.begin(), scanline.present.begin() + begin, 0.0F);
  std::fill(scanline.present.begin() + end, scanline.present.end(), 0.0F);
  const std::span<float> samples = scanline.samples.span();
  for (std::size_t i = 0; i < samples.size(); ++i) {
    if (scanline.present[i % width] == 0.0F) samples[i] = 0.0F;
  }
}

ScanlineMeans::ScanlineMeans(int channel_count, std::vector<AreaShare> lines,
                             std::vector<AreaShare> samples, int line_count, int samples_per_line)
    : channel_count_(channel_count),
      lines_(std::move(lines)),
      samples_(std::move(samples)),
      samples_per_line_(samples_per_line),
      means_(plane_size() * (channel_count + 1) * line_count) {
  for (LineSum& sum : sums_) {
    sum.samples.resize_zeroed(samples_.size() * channel_count);
    sum.present.resize_zeroed(samples_.size());
  }
}

void ScanlineMeans::LineSum::clear(int new_line) {
  line = new_line;
  scanline_count = 0;
  whole_weight = 0.0F;
  has_gaps = false;
  std::ranges::fill(samples.span(), 0.0F);
}

void ScanlineMeans::add(int index, const Scanline& scanline) {
  const AreaShare& share = lines_[index];
  if (share.weight > 0.0F) add_to(share.first, kHeadroom * share.weight, scanline);
  if (share.weight_behind > 0.0F)
    add_to(share.first + 1, kHeadroom * share.weight_behind, scanline);
}

void ScanlineMeans::finish() {
  for (LineSum& sum : sums_) fold(sum);
}

double ScanlineMeans::mean(int channel, int line, int sample) const {
  const double weight = means_[plane(channel_count_, line) + sample];
  return weight > 0.0 ? means_[plane(channel, line) + sample] / weight : 0.0;
}

bool ScanlineMeans::has_light(int line, int sample) const {
  return means_[plane(channel_count_, line) + sample] > 0.0;
}

void ScanlineMeans::add_to(int line, float weight, const Scanline& scanline) {
  LineSum& sum = sums_[line % 2];  // a scanline lies in two lines at most, one after the other
  if (sum.line != line || sum.scanline_count == kMaxSummedScanlines) {
    fold(sum);
    sum.clear(line);
  }
  ++sum.scanline_count;
  add_scaled(scanline.samples.span(), weight, sum.samples.span());
  if (scanline.present.empty()) {
    sum.whole_weight += weight;
    return;
  }
  if (!sum.has_gaps) std::ranges::fill(sum.present.span(), 0.0F);
  sum.has_gaps = true;
  add_scaled(scanline.present, weight, sum.present.span());
}

void ScanlineMeans::fold(const LineSum& sum) {
  if (sum.line < 0) return;
  for (int c = 0; c < channel_count_; ++c) {
    fold_plane(sum.samples.span().subspan(c * samples_.size(), samples_.size()), 0.0F,
               means_.data() + plane(c, sum.line));
  }
  const std::span<const float> present = sum.present.span();
  fold_plane(sum.has_gaps ? present : std::span<const float>(), sum.whole_weight,
             means_.data() + plane(channel_count_, sum.line));
}

// Adds `more` to each of `from`; an empty `from` is zeros.
void ScanlineMeans::fold_plane(std::span<const float> from, float more, double* to) const {
  for (std::size_t i = 0; i < samples_.size(); ++i) {
    const AreaShare& share = samples_[i];
    const double value = (from.empty() ? 0.0 : static_cast<double>(from[i])) + more;
    to[share.first] += share.weight * value;
    to[share.first + 1] += share.weight_behind * value;
  }
}

}  // namespace shoal
