#include "transform/projector.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <mutex>
#include <numbers>
#include <optional>
#include <utility>

#include "kernels/row_moments.h"
#include "sphere/linear_operations.h"
#include "transform/moment_table.h"
#include "transform/reference_projector.h"
#include "transform/simd_codecs.h"

namespace shoal {
namespace {

// Samples as large as this could overflow the kernel's sums of up to 128 of them; such rows go
// through it scaled down by a power of two, which loses nothing beside values so large.
constexpr std::uint32_t kHugeMagnitudeBits = (112U + 127U) << 23;
constexpr float kHugeScale = 0x1p-16F;

using Clock = std::chrono::steady_clock;

EquirectGrid grid_of(const PictureInfo& info) {
  return {info.width, info.height,
          info.positions == PixelPositions::endpoints ? Sampling::endpoints : Sampling::centers};
}

}  // namespace

// What one worker holds while it works on one panorama.
struct ProjectionWorker {
  PixelTally tally;
  kernels::RowMomentScratch scratch;
  std::vector<kernels::SampleRange> ranges;
  AlignedBuffer<float> samples;  // (3, width): one scanline as floats
};

struct PanoramaProjection::Impl {
  std::string path;
  ProjectionSettings settings;
  std::unique_ptr<PanoramaSource> source;
  EquirectGrid grid;
  std::shared_ptr<const GridTables> tables;
  MomentTable moments;
  MomentTable clamped_away;  // degree 0: what the clamp took from each row
  std::optional<ReferenceProjector> reference;

  std::atomic<int> next_band{0};
  std::atomic<bool> taken{false};   // by the one worker of a panorama that cannot be shared
  std::atomic<bool> failed{false};  // by any worker: the others need not go on
  mutable std::mutex tally_mutex;   // guards what follows
  PixelTally tally;
  Seconds seconds;

  [[nodiscard]] const PictureInfo& info() const { return source->info(); }
  [[nodiscard]] bool shareable() const {
    return info().band_access == BandAccess::random && info().scan_axis == ScanAxis::rows &&
           !reference;
  }
  [[nodiscard]] int claim_band(const std::atomic<bool>& stop);
  [[nodiscard]] ScanlinePlace place_of(int scanline) const;
  [[nodiscard]] bool needs_policy(const kernels::SampleRange& range) const;
  [[nodiscard]] kernels::MomentSlots slots_from(int row);
  PolicyRow treat(const RowBand& band, int scanline, ProjectionWorker& worker);
  void project_rows(const RowBand& band, ProjectionWorker& worker);
  void reproject_row(const RowBand& band, int row, ProjectionWorker& worker);
  void add_column(int column, const PolicyRow& treated);
  void add_to_reference(int scanline, const PolicyRow& treated);
  void project_band(const RowBand& band, ProjectionWorker& worker);
  [[nodiscard]] Status check_policy() const;
  [[nodiscard]] PixelReport report() const;
};

// The next band for a worker, or -1.
int PanoramaProjection::Impl::claim_band(const std::atomic<bool>& stop) {
  if (stop || failed || next_band >= info().band_count) return -1;
  const int band = next_band++;
  return band < info().band_count ? band : -1;
}

ScanlinePlace PanoramaProjection::Impl::place_of(int scanline) const {
  const bool reversed = info().samples_reversed;
  const int step = reversed ? -1 : 1;
  if (info().scan_axis == ScanAxis::rows) {
    return {scanline, reversed ? info().width - 1 : 0, 0, step};
  }
  return {reversed ? info().height - 1 : 0, scanline, step, 0};
}

bool PanoramaProjection::Impl::needs_policy(const kernels::SampleRange& range) const {
  const double clamp = settings.pixels.clamp;
  return !range.finite() || range.minimum < 0.0F || (clamp > 0.0 && range.maximum > clamp) ||
         range.magnitude_bits >= kHugeMagnitudeBits;
}

kernels::MomentSlots PanoramaProjection::Impl::slots_from(int row) {
  return {moments.values.data() + row,
          static_cast<std::ptrdiff_t>(moments.moment_count) * moments.row_count, moments.row_count};
}

// One scanline as floats, tallied, and with the policy applied.
PolicyRow PanoramaProjection::Impl::treat(const RowBand& band, int scanline,
                                          ProjectionWorker& worker) {
  const auto width = static_cast<std::size_t>(band.width);
  worker.samples.resize_uninitialised(kMaxChannels * width);
  PolicyRow treated;
  treated.channel_count = band.channel_count;
  for (int c = 0; c < band.channel_count; ++c) {
    treated.channels[c] = worker.samples.span().subspan(c * width, width);
    kernels::widen_row(band, scanline, c, worker.scratch, treated.channels[c].data());
  }
  const ScanlinePlace place = place_of(band.row_begin + scanline);
  const double edge_weight = column_angles(grid).edge_weight;
  const auto record = [&](int channel, std::size_t sample, double amount) {
    const bool at_edge = sample == 0 || sample + 1 == width;
    const auto row = place.row + static_cast<std::int64_t>(sample) * place.row_step;
    clamped_away.column(channel, 0)[row] += at_edge ? edge_weight * amount : amount;
  };
  apply_pixel_policy(settings.pixels, treated, place, worker.tally, record);
  return treated;
}

// The rows whose samples are ordinary light, which is nearly all, are done after one pass of the
// kernel.
void PanoramaProjection::Impl::project_rows(const RowBand& band, ProjectionWorker& worker) {
  const auto channels = static_cast<std::size_t>(band.channel_count);
  worker.ranges.resize(channels * band.row_count());
  kernels::row_moments(tables->moments, band, worker.scratch, slots_from(band.row_begin),
                       worker.ranges);
  for (int row = 0; row < band.row_count(); ++row) {
    const auto ranges = std::span(worker.ranges).subspan(row * channels, channels);
    if (std::ranges::any_of(ranges, [&](const auto& range) { return needs_policy(range); })) {
      reproject_row(band, row, worker);
      continue;
    }
    for (int c = 0; c < band.channel_count; ++c) {
      worker.tally.see_extremes(c, ranges[c].minimum, ranges[c].maximum);
    }
  }
}

// A row that the policy concerns goes through the kernel once more, as it is after the policy.
void PanoramaProjection::Impl::reproject_row(const RowBand& band, int row,
                                             ProjectionWorker& worker) {
  const auto range = std::span(worker.ranges).subspan(row * band.channel_count, band.channel_count);
  // A channel that is not finite may hide huge samples among those that are.
  const bool may_be_huge = std::ranges::any_of(
      range, [](const auto& r) { return r.magnitude_bits >= kHugeMagnitudeBits; });
  const float scale = may_be_huge ? kHugeScale : 1.0F;
  const PolicyRow treated = treat(band, row, worker);
  RowBand as_band{0, 1, band.width, band.channel_count, {}, {}};
  for (int c = 0; c < band.channel_count; ++c) {
    for (float& sample : treated.channels[c]) sample *= scale;
    as_band.channels[c] = {std::as_bytes(treated.channels[c]).data(), 0, SampleType::float32};
  }
  const int picture_row = band.row_begin + row;
  std::array<kernels::SampleRange, kMaxChannels> unused;
  kernels::row_moments(tables->moments, as_band, worker.scratch, slots_from(picture_row), unused);
  for (int c = 0; c < band.channel_count; ++c) {
    for (int k = 0; k < moments.moment_count; ++k) {
      moments.column(c, k)[picture_row] /= static_cast<double>(scale);
    }
  }
}

// A scanline that is a column adds its part to the moments of every row. One worker reads such a
// file in order, so that these sums have a fixed order too.
void PanoramaProjection::Impl::add_column(int column, const PolicyRow& treated) {
  const kernels::ColumnPhases phases = column_phases(grid);
  for (int c = 0; c < treated.channel_count; ++c) {
    const std::span<float> samples = treated.channels[c];
    if (info().samples_reversed) std::ranges::reverse(samples);
    for (int k = 0; k < moments.moment_count; ++k) {
      const int m = k <= settings.degree ? k : k - settings.degree;
      const std::int64_t phase = (phases.first + phases.step * column) * m % phases.turn;
      const long double angle =
          2.0L * std::numbers::pi_v<long double> * phase / static_cast<long double>(phases.turn);
      const auto trig =
          static_cast<double>(k <= settings.degree ? std::cos(angle) : std::sin(angle));
      double* slots = moments.column(c, k);
      for (std::size_t i = 0; i < samples.size(); ++i) slots[i] += trig * samples[i];
    }
  }
}

// The moments of order 0 are kept too, for the mean.
void PanoramaProjection::Impl::add_to_reference(int scanline, const PolicyRow& treated) {
  const ScanlinePlace place = place_of(scanline);
  const auto width = static_cast<int>(treated.channels[0].size());
  for (int j = 0; j < width; ++j) {
    std::array<float, kChannelCount> sample;
    for (int c = 0; c < kChannelCount; ++c) {
      sample[c] = treated.channels[treated.channel_count == 1 ? 0 : c][j];
    }
    const int row = static_cast<int>(place.row) + j * place.row_step;
    reference->add_pixel(row, static_cast<int>(place.column) + j * place.column_step, sample);
    for (int c = 0; c < treated.channel_count; ++c) moments.column(c, 0)[row] += sample[c];
  }
}

void PanoramaProjection::Impl::project_band(const RowBand& band, ProjectionWorker& worker) {
  if (!reference && info().scan_axis == ScanAxis::rows) return project_rows(band, worker);
  for (int row = 0; row < band.row_count(); ++row) {
    const PolicyRow treated = treat(band, row, worker);
    if (reference) {
      add_to_reference(band.row_begin + row, treated);
    } else {
      add_column(band.row_begin + row, treated);
    }
  }
}

Status PanoramaProjection::Impl::check_policy() const {
  if (tally.nonfinite_count == 0 || settings.pixels.nonfinite == PixelPolicy::NonFinite::zero) {
    return {};
  }
  const std::string row = std::to_string(tally.first_nonfinite_row);
  return Error{ErrorCode::pixels,
               std::to_string(tally.nonfinite_count) +
                   (tally.nonfinite_count == 1 ? " pixel is" : " pixels are") +
                   " not finite (NaN or infinity), the first in row " + row + ", column " +
                   std::to_string(tally.first_nonfinite_column),
               path + ":" + row, "nonfinite: zero takes them as black"};
}

PixelReport PanoramaProjection::Impl::report() const {
  PixelReport report;
  report.pixel_count = static_cast<std::int64_t>(info().width) * info().height;
  report.nonfinite_count = tally.nonfinite_count;
  report.negative_count = tally.negative_count;
  report.clamped_count = tally.clamped_count;
  const ProjectionWeights& weights = tables->weights;
  const Coefficients flux =
      report.clamped_count == 0
          ? Coefficients(0)
          : contract(clamped_away, make_projection_weights(grid, weights.quadrature, 0));
  const int columns = grid.sampling == Sampling::endpoints ? grid.width - 1 : grid.width;
  const double sample_count = static_cast<double>(columns) * grid.height;
  for (int c = 0; c < kChannelCount; ++c) {
    const int channel = info().channel_count == 1 ? 0 : c;
    // A picture without a single finite sample has no extremes.
    const bool any = tally.minimum[channel] <= tally.maximum[channel];
    report.minimum[c] = any ? tally.minimum[channel] : 0.0;
    report.maximum[c] = any ? tally.maximum[channel] : 0.0;
    const double* sums = moments.column(channel, 0);
    for (int i = 0; i < grid.height; ++i) report.mean[c] += sums[i];
    report.mean[c] /= sample_count;
    // The integral of a function is sqrt(4 pi) times its coefficient of degree 0.
    report.clamped_flux[c] = flux.channels[c][0] * std::sqrt(4.0 * std::numbers::pi);
  }
  return report;
}

PanoramaProjection::PanoramaProjection() : impl_(std::make_unique<Impl>()) {}
PanoramaProjection::~PanoramaProjection() = default;

const PictureInfo& PanoramaProjection::info() const { return impl_->info(); }

Result<std::unique_ptr<PanoramaProjection>> PanoramaProjection::open(
    const std::filesystem::path& path, const ReadOptions& options,
    const ProjectionSettings& settings, ProjectionTables& tables) {
  SHOAL_ASSIGN_OR_RETURN(source, open_panorama(path, options, simd_chunk_codecs()));
  std::unique_ptr<PanoramaProjection> projection(new PanoramaProjection());
  Impl& impl = *projection->impl_;
  impl.path = path.string();
  impl.settings = settings;
  impl.source = std::move(source);
  impl.grid = grid_of(impl.info());
  const Quadrature quadrature = effective_quadrature(settings.quadrature, impl.grid.sampling);
  impl.tables = tables.get(impl.grid, quadrature, settings.degree);
  const int channels = impl.info().channel_count;
  impl.moments = MomentTable(channels, settings.degree, impl.grid.height);
  impl.clamped_away = MomentTable(channels, 0, impl.grid.height);
  if (settings.arithmetic == Arithmetic::reference) {
    impl.reference.emplace(impl.grid, quadrature, settings.degree);
  }
  return projection;
}

bool PanoramaProjection::wants_workers() const {
  if (impl_->failed || impl_->next_band >= info().band_count) return false;
  return impl_->shareable() || !impl_->taken;
}

PanoramaProjection::Seconds PanoramaProjection::seconds() const {
  const std::scoped_lock lock(impl_->tally_mutex);
  return impl_->seconds;
}

Status PanoramaProjection::work(const std::atomic<bool>& stop,
                                std::atomic<std::int64_t>& pixels_done) {
  Impl& impl = *impl_;
  if (!impl.shareable() && impl.taken.exchange(true)) return {};
  if (!wants_workers() && impl.shareable()) return {};
  SHOAL_ASSIGN_OR_RETURN(reader, impl.source->new_reader());
  ProjectionWorker worker;
  Seconds seconds;
  for (int index = impl.claim_band(stop); index >= 0; index = impl.claim_band(stop)) {
    const auto begin = Clock::now();
    auto band = reader->read(index);
    const auto read = Clock::now();
    if (!band) {
      impl.failed = true;
      return std::move(band).error();
    }
    impl.project_band(*band, worker);
    pixels_done += static_cast<std::int64_t>(band->width) * band->row_count();
    seconds.reading += std::chrono::duration<double>(read - begin).count();
    seconds.projecting += std::chrono::duration<double>(Clock::now() - read).count();
  }
  const std::scoped_lock lock(impl.tally_mutex);
  impl.tally.merge(worker.tally);
  impl.seconds.reading += seconds.reading;
  impl.seconds.projecting += seconds.projecting;
  if (stop) {
    impl.failed = true;  // or workers without work would join it again and again
    return Error{ErrorCode::interrupted, "interrupted", impl.path, ""};
  }
  return {};
}

Result<Projection> PanoramaProjection::finish() {
  Impl& impl = *impl_;
  SHOAL_RETURN_IF_ERROR(impl.check_policy());
  Projection result;
  result.grid = impl.grid;
  result.format = info().format;
  result.quadrature = impl.tables->weights.quadrature;
  result.solid_angle = impl.tables->weights.solid_angle;
  result.warnings = info().warnings;
  result.pixels = impl.report();
  std::ranges::copy(warnings_of(result.pixels, impl.settings.pixels),
                    std::back_inserter(result.warnings));
  result.radiance = impl.reference ? impl.reference->coefficients()
                                   : contract(impl.moments, impl.tables->weights);
  // A mirrored row has the same cosine sums and the opposite sine sums. The twin saw it unmirrored.
  if (!impl.reference && info().scan_axis == ScanAxis::rows && info().samples_reversed) {
    for (auto& channel : result.radiance.channels) {
      for (int l = 1; l <= result.radiance.degree; ++l) {
        for (int m = -l; m < 0; ++m) channel[coefficient_index(l, m)] *= -1.0;
      }
    }
  }
  result.radiance = apply_matrix(std::move(result.radiance), info().to_linear_rec709);
  for (const auto& channel : result.radiance.channels) {
    if (!std::ranges::all_of(channel, [](double value) { return std::isfinite(value); })) {
      return Error{ErrorCode::pixels, "the sums of its pixels leave the range of numbers",
                   impl.path, "clamp: takes away what no light can be"};
    }
  }
  return result;
}

Result<Projection> project_panorama(const std::filesystem::path& path, const ReadOptions& options,
                                    const ProjectionSettings& settings, ProjectionTables& tables) {
  SHOAL_ASSIGN_OR_RETURN(projection, PanoramaProjection::open(path, options, settings, tables));
  const std::atomic<bool> stop{false};
  std::atomic<std::int64_t> pixels_done{0};
  SHOAL_RETURN_IF_ERROR(projection->work(stop, pixels_done));
  return projection->finish();
}

}  // namespace shoal
