#include "transform/preview.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <span>
#include <utility>

#include "core/aligned_buffer.h"
#include "kernels/row_moments.h"
#include "transform/area_weights.h"
#include "transform/simd_codecs.h"

namespace shoal {
namespace {

// Scanlines summed in single precision: with 2^-24 for each product and each sum, (32 + 2) u.
constexpr int kMaxSummedScanlines = 32;

// Of all weights of scanlines, so that sums of the largest floats are floats still, although
// weights sum to 1 but for rounding. Divided out with the weights.
constexpr float kHeadroom = 0.5F;

// The sum of some scanlines that belong to one line of the preview.
struct LineSum {
  int line = -1;
  int scanline_count = 0;
  float whole_weight = 0.0F;     // of the scanlines without a texel that is left out
  bool has_gaps = false;         // `present` counts as well
  AlignedBuffer<float> samples;  // (channel_count, sample_count)
  AlignedBuffer<float> present;  // (sample_count): weights of the other scanlines' texels

  void clear(int new_line) {
    line = new_line;
    scanline_count = 0;
    whole_weight = 0.0F;
    has_gaps = false;
    std::ranges::fill(samples.span(), 0.0F);
  }
};

// One scanline as floats.
struct Scanline {
  AlignedBuffer<float> samples;  // (channel_count, sample_count)
  std::vector<float> present;    // empty, or 0 where a texel is left out and 1 elsewhere
};

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

// Gathers scanlines, in whatever order they come, into the lines of a preview. Scanlines may be
// rows or columns; "samples" run along them.
class ScanlineMeans {
 public:
  ScanlineMeans(int channel_count, std::vector<AreaShare> lines, std::vector<AreaShare> samples,
                int line_count, int samples_per_line)
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

  void add(int index, const Scanline& scanline) {
    const AreaShare& share = lines_[index];
    if (share.weight > 0.0F) add_to(share.first, kHeadroom * share.weight, scanline);
    if (share.weight_behind > 0.0F)
      add_to(share.first + 1, kHeadroom * share.weight_behind, scanline);
  }

  void finish() {
    for (LineSum& sum : sums_) fold(sum);
  }

  // Of one texel; black where nothing was present.
  [[nodiscard]] double mean(int channel, int line, int sample) {
    const double weight = plane(channel_count_, line)[sample];
    return weight > 0.0 ? plane(channel, line)[sample] / weight : 0.0;
  }

 private:
  // One more than there are, for the share behind the last, which is 0.
  [[nodiscard]] std::size_t plane_size() const { return samples_per_line_ + std::size_t{1}; }
  [[nodiscard]] double* plane(int channel, int line) {
    return means_.data() +
           (static_cast<std::size_t>(line) * (channel_count_ + 1) + channel) * plane_size();
  }

  void add_to(int line, float weight, const Scanline& scanline) {
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

  void fold(const LineSum& sum) {
    if (sum.line < 0) return;
    for (int c = 0; c < channel_count_; ++c) {
      fold_plane(sum.samples.span().subspan(c * samples_.size(), samples_.size()), 0.0F,
                 plane(c, sum.line));
    }
    const std::span<const float> present = sum.present.span();
    fold_plane(sum.has_gaps ? present : std::span<const float>(), sum.whole_weight,
               plane(channel_count_, sum.line));
  }

  // Adds `more` to each of `from`; an empty `from` is zeros.
  void fold_plane(std::span<const float> from, float more, double* to) const {
    for (std::size_t i = 0; i < samples_.size(); ++i) {
      const AreaShare& share = samples_[i];
      const double value = (from.empty() ? 0.0 : static_cast<double>(from[i])) + more;
      to[share.first] += share.weight * value;
      to[share.first + 1] += share.weight_behind * value;
    }
  }

  int channel_count_;
  std::vector<AreaShare> lines_;
  std::vector<AreaShare> samples_;
  int samples_per_line_;
  std::array<LineSum, 2> sums_;
  std::vector<double> means_;  // (lines, channel_count + 1, plane_size): sums, and their weights
};

// Row `row` of the band, and which of its texels are left out.
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

struct Sizes {
  int width = 0;
  int height = 0;
};

Sizes preview_sizes(const PictureInfo& info, int width) {
  // The cells of a grid that ends on the poles are one less than its texels.
  const int missing = info.positions == PixelPositions::endpoints ? 1 : 0;
  const int small = std::min(width, std::max(1, info.width - missing));
  return {small, std::min((small + 1) / 2, std::max(1, info.height - missing))};
}

ScanlineMeans means_for(const PictureInfo& info, Sizes small) {
  const Sampling sampling =
      info.positions == PixelPositions::endpoints ? Sampling::endpoints : Sampling::centers;
  std::vector<AreaShare> rows = row_shares(info.height, small.height, sampling);
  std::vector<AreaShare> columns = column_shares(info.width, small.width, sampling);
  const bool by_rows = info.scan_axis == ScanAxis::rows;
  if (info.samples_reversed) std::ranges::reverse(by_rows ? columns : rows);
  if (by_rows) {
    return {info.channel_count, std::move(rows), std::move(columns), small.height, small.width};
  }
  return {info.channel_count, std::move(columns), std::move(rows), small.width, small.height};
}

Status gather(const PanoramaSource& source, const std::atomic<bool>& stop, ScanlineMeans& means) {
  SHOAL_ASSIGN_OR_RETURN(reader, source.new_reader());
  kernels::RowMomentScratch scratch;
  Scanline scanline;
  for (int index = 0; index < source.info().band_count; ++index) {
    if (stop) return Error{ErrorCode::interrupted, "interrupted", "", ""};
    SHOAL_ASSIGN_OR_RETURN(band, reader->read(index));
    for (int row = 0; row < band.row_count(); ++row) {
      read_scanline(band, row, scratch, scanline);
      means.add(band.row_begin + row, scanline);
    }
  }
  means.finish();
  return {};
}

float within_floats(double value) {
  constexpr double kMost = std::numeric_limits<float>::max();
  return static_cast<float>(std::clamp(value, -kMost, kMost));
}

void fill_planes(const PictureInfo& info, ScanlineMeans& means, Preview& preview) {
  const bool by_rows = info.scan_axis == ScanAxis::rows;
  for (auto& plane : preview.planes) {
    plane.reserve(static_cast<std::size_t>(preview.width) * preview.height);
  }
  for (int row = 0; row < preview.height; ++row) {
    for (int column = 0; column < preview.width; ++column) {
      glm::dvec3 colour;
      for (int c = 0; c < 3; ++c) {
        const int channel = info.channel_count == 1 ? 0 : c;
        colour[c] = by_rows ? means.mean(channel, row, column) : means.mean(channel, column, row);
      }
      colour = info.to_linear_rec709 * colour;
      for (int c = 0; c < 3; ++c) preview.planes[c].push_back(within_floats(colour[c]));
    }
  }
}

}  // namespace

Result<Preview> make_preview(const std::filesystem::path& path, const ReadOptions& options,
                             int width, const std::atomic<bool>& stop) {
  const ChunkCodecs codecs = simd_chunk_codecs();
  SHOAL_ASSIGN_OR_RETURN(source, open_panorama(path, options, codecs));
  const PictureInfo& info = source->info();
  if (info.environment == EnvironmentMap::cube ||
      info.environment == EnvironmentMap::cube_strip) {
    return Error{ErrorCode::unsupported, "is a cube map; previews are made of equirect panoramas",
                 path.string(), "write it as an equirect map first: maps: [{kind: radiance}]"};
  }
  const Sizes small = preview_sizes(info, width);
  ScanlineMeans means = means_for(info, small);
  Status gathered = gather(*source, stop, means);
  if (!gathered) return std::move(gathered).error();
  Preview preview;
  preview.width = small.width;
  preview.height = small.height;
  preview.warnings = info.warnings;
  if (info.positions == PixelPositions::endpoints) {
    preview.warnings.emplace_back(
        "Its border texels lie on the poles and on the seam; the preview takes each texel for the "
        "cell around it.");
  }
  fill_planes(info, means, preview);
  return preview;
}

Status write_preview(const Preview& preview, MapFormat format, const std::filesystem::path& path) {
  MapFile file;
  file.format = format;
  file.width = preview.width;
  file.height = preview.height;
  SHOAL_ASSIGN_OR_RETURN(writer, MapWriter::create(path, file));
  const auto& [red, green, blue] = preview.planes;
  SHOAL_RETURN_IF_ERROR(
      writer->write_rows({red.data(), green.data(), blue.data()}, preview.width, preview.height));
  return writer->commit();
}

}  // namespace shoal
