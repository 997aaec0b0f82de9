#include "transform/direction_sums.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "sphere/basis.h"
#include "sphere/linear_operations.h"

namespace shoal {

// The texels of one scanline that show some of the sphere, as a band of one row.
struct DirectionSums::Scanline {
  RowBand band;
  ScanlinePlace place;  // of the band's first sample
  kernels::TexelDirections directions;
};

namespace {

RowBand cut(const RowBand& band, int row, const TexelSpan& span) {
  RowBand part{0, 1, span.size(), band.channel_count, {}, {}};
  const auto cut_plane = [&](const Plane& plane) -> Plane {
    const auto offset = static_cast<std::ptrdiff_t>(sample_size(plane.type)) * span.begin;
    return {plane.row(row) + offset, 0, plane.type};
  };
  for (int c = 0; c < band.channel_count; ++c) part.channels[c] = cut_plane(band.channels[c]);
  if (band.exponent.data != nullptr) {
    part.exponent = {band.exponent.row(row) + span.begin, 0, band.exponent.type};
  }
  return part;
}

}  // namespace

DirectionSums::DirectionSums(const PictureInfo& info, const ProjectionSettings& settings,
                             const TexelGeometry& geometry)
    : PictureSums(info, settings),
      geometry_(geometry),
      plan_(kernels::make_direction_plan(settings.highest_degree())),
      channel_count_(info.channel_count),
      flux_offset_(static_cast<std::size_t>(info.channel_count) * plan_.coefficient_count()),
      sums_(info.scan_axis == ScanAxis::rows ? info.height : info.width,
            flux_offset_ + channel_count_ + 1) {
  if (settings.arithmetic == Arithmetic::reference) reference_.emplace(settings.highest_degree());
}

void DirectionSums::add_rows(const RowBand& band, ProjectionWorker& worker) {
  for (int row = 0; row < band.row_count(); ++row) add_scanline(band, row, worker);
}

void DirectionSums::add_scanline(const RowBand& band, int row, ProjectionWorker& worker) {
  const int number = band.row_begin + row;
  const ScanlinePlace place = scanline_place(info_, number);
  const TexelLine line{static_cast<int>(place.row), static_cast<int>(place.column), place.row_step,
                       place.column_step, band.width};
  const TexelSpan span = geometry_.span_of(line);
  if (span.size() == 0) return sums_.add(number, {});

  const auto count = static_cast<std::size_t>(span.size());
  worker.directions.resize_uninitialised(4 * count);
  float* arrays = worker.directions.data();
  const double solid_angle =
      geometry_.fill(line, span, {arrays, arrays + count, arrays + 2 * count, arrays + 3 * count});
  worker.sums.assign(flux_offset_ + channel_count_ + 1, 0.0);
  worker.sums.back() = solid_angle;
  const Scanline scanline{cut(band, row, span),
                          {place.row + std::int64_t{span.begin} * place.row_step,
                           place.column + std::int64_t{span.begin} * place.column_step,
                           place.row_step, place.column_step},
                          {arrays, arrays + count, arrays + 2 * count, arrays + 3 * count}};
  if (reference_) {
    look_at(scanline.band, 0, scanline.place, {}, worker);
    sum_by_reference(scanline, worker);
  } else {
    sum_by_kernel(scanline, worker);
  }
  sums_.add(number, worker.sums);
}

OnClamp DirectionSums::clamp_record(const Scanline& scanline, ProjectionWorker& worker) const {
  double* flux = worker.sums.data() + flux_offset_;
  const float* solid_angles = scanline.directions.solid_angle;
  return [flux, solid_angles](int channel, std::size_t sample, double amount) {
    flux[channel] += amount * solid_angles[sample];
  };
}

void DirectionSums::sum_by_kernel(const Scanline& scanline, ProjectionWorker& worker) const {
  const std::span<double> sums = std::span(worker.sums).first(flux_offset_);
  worker.ranges.resize(channel_count_);
  kernels::direction_moments(plan_, scanline.band, 0, scanline.directions, worker.direction_scratch,
                             sums, worker.ranges);
  look_at(scanline.band, 0, scanline.place, worker.ranges, worker);
  if (!needs_policy(worker.ranges)) {
    for (int c = 0; c < channel_count_; ++c) {
      worker.tally.see_extremes(c, worker.ranges[c].minimum, worker.ranges[c].maximum);
    }
    return;
  }
  // Once more, as the samples are after the policy.
  const TreatedBand treated = treat_for_kernel(scanline.band, 0, scanline.place, worker.ranges,
                                               clamp_record(scanline, worker), worker);
  kernels::direction_moments(plan_, treated.band, 0, scanline.directions, worker.direction_scratch,
                             sums, worker.ranges);
  for (double& sum : sums) sum /= treated.scale;
}

void DirectionSums::sum_by_reference(const Scanline& scanline, ProjectionWorker& worker) {
  const PolicyRow treated =
      treat(scanline.band, 0, scanline.place, clamp_record(scanline, worker), worker);
  for (int j = 0; j < scanline.band.width; ++j) {
    std::array<float, kChannelCount> sample;
    for (int c = 0; c < kChannelCount; ++c) {
      sample[c] = treated.channels[treated.channel_count == 1 ? 0 : c][j];
    }
    const Texel texel =
        geometry_.texel(static_cast<int>(scanline.place.row) + j * scanline.place.row_step,
                        static_cast<int>(scanline.place.column) + j * scanline.place.column_step);
    reference_->add_texel(texel, sample);
  }
}

void DirectionSums::change(std::span<const TexelChange> changes) {
  if (changes.empty()) return;
  const auto count = static_cast<std::size_t>(plan_.coefficient_count());
  const Basis<double> basis(plan_.degree);
  std::vector<double> values(count);
  changes_.assign(flux_offset_, 0.0);
  for (const TexelChange& change : changes) {
    const Texel where = geometry_.texel(change.row, change.column);
    if (reference_) {
      std::array<float, kChannelCount> removed = change.from;
      for (float& sample : removed) sample = -sample;
      reference_->add_texel(where, removed);
      reference_->add_texel(where, change.to);
      continue;
    }
    basis.evaluate(where.direction, values);
    for (int c = 0; c < channel_count_; ++c) {
      const double amount = where.solid_angle * (static_cast<double>(change.to[c]) -
                                                 static_cast<double>(change.from[c]));
      for (std::size_t i = 0; i < count; ++i) changes_[c * count + i] += amount * values[i];
    }
  }
}

PictureTotals DirectionSums::totals() {
  std::vector<double> sums = sums_.total();
  for (std::size_t i = 0; i < changes_.size(); ++i) sums[i] += changes_[i];
  PictureTotals totals;
  totals.quadrature = Quadrature::midpoint;
  totals.solid_angle = sums.back();
  totals.pixel_count = geometry_.texel_count();
  totals.radiance = Coefficients(plan_.degree);
  const auto count = static_cast<std::size_t>(plan_.coefficient_count());
  for (int c = 0; c < kChannelCount; ++c) {
    const std::size_t channel = channel_count_ == 1 ? 0 : c;
    std::copy_n(sums.begin() + static_cast<std::ptrdiff_t>(channel * count), count,
                totals.radiance.channels[c].begin());
    totals.clamped_flux[c] = sums[flux_offset_ + channel];
  }
  if (reference_) totals.radiance = reference_->coefficients();
  if (plan_.degree > settings_.degree) {
    totals.finer = totals.radiance;
    totals.radiance = truncate(std::move(totals.radiance), settings_.degree);
  }
  for (int c = 0; c < kChannelCount; ++c) {
    totals.mean[c] =
        totals.radiance.channels[c][0] * std::sqrt(4.0 * std::numbers::pi) / totals.solid_angle;
  }
  return totals;
}

}  // namespace shoal
