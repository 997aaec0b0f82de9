#include "transform/equirect_sums.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace shoal {

EquirectGrid grid_of(const PictureInfo& info) {
  return {info.width, info.height,
          info.positions == PixelPositions::endpoints ? Sampling::endpoints : Sampling::centers};
}

EquirectSums::EquirectSums(const PictureInfo& info, const ProjectionSettings& settings,
                           ProjectionTables& tables)
    : PictureSums(info, settings),
      grid_(grid_of(info)),
      moments_(info.channel_count, settings.highest_degree(), info.height),
      clamped_away_(info.channel_count, 0, info.height) {
  const Quadrature quadrature = effective_quadrature(settings.quadrature, grid_.sampling);
  const int highest = settings.highest_degree();
  tables_ = tables.get(grid_, quadrature, settings.degree);
  finest_tables_ = tables.get(grid_, quadrature, highest);
  if (settings.arithmetic == Arithmetic::kernels) return;
  reference_.emplace(grid_, quadrature, settings.degree);
  if (highest > settings.degree) finest_reference_.emplace(grid_, quadrature, highest);
}

bool EquirectSums::shareable() const { return info_.scan_axis == ScanAxis::rows && !reference_; }

kernels::MomentSlots EquirectSums::slots_from(int row) {
  return {moments_.values.data() + row,
          static_cast<std::ptrdiff_t>(moments_.moment_count) * moments_.row_count,
          moments_.row_count};
}

OnClamp EquirectSums::clamp_record(const ScanlinePlace& place, int width) {
  const double edge_weight = column_angles(grid_).edge_weight;
  const auto last = static_cast<std::size_t>(width) - 1;
  return [this, place, edge_weight, last](int channel, std::size_t sample, double amount) {
    const bool at_edge = sample == 0 || sample == last;
    const auto row = place.row + static_cast<std::int64_t>(sample) * place.row_step;
    clamped_away_.column(channel, 0)[row] += at_edge ? edge_weight * amount : amount;
  };
}

// The rows whose samples are ordinary light, which is nearly all, are done after one pass of the
// kernel.
void EquirectSums::project_rows(const RowBand& band, ProjectionWorker& worker) {
  const auto channels = static_cast<std::size_t>(band.channel_count);
  worker.ranges.resize(channels * band.row_count());
  kernels::row_moments(finest_tables_->moments, band, worker.scratch, slots_from(band.row_begin),
                       worker.ranges);
  for (int row = 0; row < band.row_count(); ++row) {
    const auto ranges = std::span(worker.ranges).subspan(row * channels, channels);
    look_at(band, row, scanline_place(info_, band.row_begin + row), ranges, worker);
    if (needs_policy(ranges)) {
      reproject_row(band, row, worker);
      continue;
    }
    for (int c = 0; c < band.channel_count; ++c) {
      worker.tally.see_extremes(c, ranges[c].minimum, ranges[c].maximum);
    }
  }
}

// A row that the policy concerns goes through the kernel once more, as it is after the policy.
void EquirectSums::reproject_row(const RowBand& band, int row, ProjectionWorker& worker) {
  const auto ranges =
      std::span(worker.ranges).subspan(row * band.channel_count, band.channel_count);
  const int picture_row = band.row_begin + row;
  const ScanlinePlace place = scanline_place(info_, picture_row);
  const TreatedBand treated =
      treat_for_kernel(band, row, place, ranges, clamp_record(place, band.width), worker);
  std::array<kernels::SampleRange, kMaxChannels> unused;
  kernels::row_moments(finest_tables_->moments, treated.band, worker.scratch,
                       slots_from(picture_row), unused);
  for (int c = 0; c < band.channel_count; ++c) {
    for (int k = 0; k < moments_.moment_count; ++k) {
      moments_.column(c, k)[picture_row] /= treated.scale;
    }
  }
}

// A scanline that is a column adds its part to the moments of every row. One worker reads such a
// file in order, so that these sums have a fixed order too.
void EquirectSums::add_column(int column, const PolicyRow& treated) {
  const kernels::ColumnPhases phases = column_phases(grid_);
  const int degree = moments_.degree();
  for (int c = 0; c < treated.channel_count; ++c) {
    const std::span<float> samples = treated.channels[c];
    if (info_.samples_reversed) std::ranges::reverse(samples);
    for (int k = 0; k < moments_.moment_count; ++k) {
      const int m = k <= degree ? k : k - degree;
      const std::int64_t phase = (phases.first + phases.step * column) * m % phases.turn;
      const long double angle =
          2.0L * std::numbers::pi_v<long double> * phase / static_cast<long double>(phases.turn);
      const auto trig = static_cast<double>(k <= degree ? std::cos(angle) : std::sin(angle));
      double* slots = moments_.column(c, k);
      for (std::size_t i = 0; i < samples.size(); ++i) slots[i] += trig * samples[i];
    }
  }
}

// The moments of order 0 are kept too, for the mean.
void EquirectSums::add_to_reference(int scanline, const PolicyRow& treated) {
  const ScanlinePlace place = scanline_place(info_, scanline);
  const auto width = static_cast<int>(treated.channels[0].size());
  for (int j = 0; j < width; ++j) {
    std::array<float, kChannelCount> sample;
    for (int c = 0; c < kChannelCount; ++c) {
      sample[c] = treated.channels[treated.channel_count == 1 ? 0 : c][j];
    }
    const int row = static_cast<int>(place.row) + j * place.row_step;
    const int column = static_cast<int>(place.column) + j * place.column_step;
    reference_->add_pixel(row, column, sample);
    if (finest_reference_) finest_reference_->add_pixel(row, column, sample);
    for (int c = 0; c < treated.channel_count; ++c) moments_.column(c, 0)[row] += sample[c];
  }
}

void EquirectSums::add_rows(const RowBand& band, ProjectionWorker& worker) {
  if (shareable()) return project_rows(band, worker);
  for (int row = 0; row < band.row_count(); ++row) {
    const int scanline = band.row_begin + row;
    const ScanlinePlace place = scanline_place(info_, scanline);
    look_at(band, row, place, {}, worker);
    const PolicyRow treated = treat(band, row, place, clamp_record(place, band.width), worker);
    if (reference_) {
      add_to_reference(scanline, treated);
    } else {
      add_column(scanline, treated);
    }
  }
}

double EquirectSums::solid_angle(int row, int column) const {
  const ProjectionWeights& weights = tables_->weights;
  const bool at_edge = column == 0 || column == grid_.width - 1;
  // The integral of a function is sqrt(4 pi) times its coefficient of degree 0.
  return std::sqrt(4.0 * std::numbers::pi) * weights.azimuth[0] *
         weights.polar_row_weights(0, 0)[std::min(row, grid_.height - 1 - row)] *
         (at_edge ? column_angles(grid_).edge_weight : 1.0);
}

Texel EquirectSums::texel(int row, int column) const {
  const PolarAngle polar = row_angle(grid_, row);
  const kernels::ColumnPhases phases = column_phases(grid_);
  const double phi = 2.0 * std::numbers::pi *
                     static_cast<double>(phases.first + phases.step * column) /
                     static_cast<double>(phases.turn);
  const auto sin_theta = static_cast<double>(polar.sin_theta);
  return {
      {sin_theta * std::cos(phi), sin_theta * std::sin(phi), static_cast<double>(polar.cos_theta)},
      solid_angle(row, column)};
}

void EquirectSums::change(std::span<const TexelChange> changes) {
  if (changes.empty()) return;
  if (!reference_) return change_moments(changes);
  for (const TexelChange& change : changes) change_reference(change);
}

// The same sums as the kernels make, of the differences and in double.
void EquirectSums::change_moments(std::span<const TexelChange> changes) {
  const kernels::ColumnPhases phases = column_phases(grid_);
  // Cosine and sine, made where they are asked for the first time.
  constexpr double kUnmade = 2.0;
  std::vector<std::array<double, 2>> made(static_cast<std::size_t>(phases.turn), {kUnmade, 0.0});
  const auto trig = [&](std::int64_t phase) {
    std::array<double, 2>& pair = made[static_cast<std::size_t>(phase % phases.turn)];
    if (pair[0] == kUnmade) {
      const long double angle = 2.0L * std::numbers::pi_v<long double> *
                                static_cast<long double>(phase % phases.turn) /
                                static_cast<long double>(phases.turn);
      pair = {static_cast<double>(std::cos(angle)), static_cast<double>(std::sin(angle))};
    }
    return pair;
  };
  // Rows are summed as they lie in the file.
  const bool mirrored = info_.scan_axis == ScanAxis::rows && info_.samples_reversed;
  const int degree = moments_.degree();
  for (const TexelChange& change : changes) {
    const int column = mirrored ? grid_.width - 1 - change.column : change.column;
    const bool at_edge = column == 0 || column == grid_.width - 1;
    const std::int64_t phase = phases.first + phases.step * column;
    for (int c = 0; c < info_.channel_count; ++c) {
      const double amount =
          (at_edge ? phases.edge_weight : 1.0) *
          (static_cast<double>(change.to[c]) - static_cast<double>(change.from[c]));
      for (int m = 0; m <= degree; ++m) {
        const auto [cosine, sine] = trig(phase * m);
        moments_.column(c, m)[change.row] += amount * cosine;
        if (m > 0) moments_.column(c, degree + m)[change.row] += amount * sine;
      }
    }
  }
}

void EquirectSums::change_reference(const TexelChange& change) {
  std::array<float, kChannelCount> removed = change.from;
  for (float& sample : removed) sample = -sample;
  for (const auto& sample : {removed, change.to}) {
    reference_->add_pixel(change.row, change.column, sample);
    if (finest_reference_) finest_reference_->add_pixel(change.row, change.column, sample);
    for (int c = 0; c < info_.channel_count; ++c) moments_.column(c, 0)[change.row] += sample[c];
  }
}

Coefficients EquirectSums::contracted(const ProjectionWeights& weights) const {
  Coefficients radiance = contract(moments_, weights);
  // A mirrored row has the same cosine sums and the opposite sine sums.
  if (info_.scan_axis == ScanAxis::rows && info_.samples_reversed) {
    for (auto& channel : radiance.channels) {
      for (int l = 1; l <= radiance.degree; ++l) {
        for (int m = -l; m < 0; ++m) channel[coefficient_index(l, m)] *= -1.0;
      }
    }
  }
  return radiance;
}

Coefficients EquirectSums::finer_than(const Coefficients& radiance) const {
  Coefficients finer =
      finest_reference_ ? finest_reference_->coefficients() : contracted(finest_tables_->weights);
  for (int c = 0; c < kChannelCount; ++c) {
    std::ranges::copy(radiance.channels[c], finer.channels[c].begin());
  }
  return finer;
}

PictureTotals EquirectSums::totals() {
  PictureTotals totals;
  const ProjectionWeights& weights = tables_->weights;
  totals.quadrature = weights.quadrature;
  totals.solid_angle = weights.solid_angle;
  totals.pixel_count = static_cast<std::int64_t>(info_.width) * info_.height;
  totals.radiance = reference_ ? reference_->coefficients() : contracted(weights);
  if (moments_.degree() > settings_.degree) totals.finer = finer_than(totals.radiance);
  const auto is_zero = [](double amount) { return amount == 0.0; };
  const Coefficients flux =
      std::ranges::all_of(clamped_away_.values, is_zero)
          ? Coefficients(0)
          : contract(clamped_away_, make_projection_weights(grid_, weights.quadrature, 0));
  const int columns = grid_.sampling == Sampling::endpoints ? grid_.width - 1 : grid_.width;
  const double sample_count = static_cast<double>(columns) * grid_.height;
  for (int c = 0; c < kChannelCount; ++c) {
    const double* sums = moments_.column(info_.channel_count == 1 ? 0 : c, 0);
    for (int i = 0; i < grid_.height; ++i) totals.mean[c] += sums[i];
    totals.mean[c] /= sample_count;
    // The integral of a function is sqrt(4 pi) times its coefficient of degree 0.
    totals.clamped_flux[c] = flux.channels[c][0] * std::sqrt(4.0 * std::numbers::pi);
  }
  return totals;
}

}  // namespace shoal
