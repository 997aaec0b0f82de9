#include "transform/projector.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <mutex>
#include <numbers>
#include <utility>

#include "sphere/colour_temperature.h"
#include "sphere/linear_operations.h"
#include "sphere/texel_geometry.h"
#include "transform/bright_changes.h"
#include "transform/direction_sums.h"
#include "transform/equirect_sums.h"
#include "transform/layout_source.h"
#include "transform/simd_codecs.h"

namespace shoal {
namespace {

using Clock = std::chrono::steady_clock;

Result<std::unique_ptr<PictureSums>> sums_for(const LaidOutPicture& picture,
                                              const ProjectionSettings& settings,
                                              ProjectionTables& tables) {
  const PictureInfo& info = picture.source->info();
  std::unique_ptr<PictureSums> sums;
  if (picture.layout == Layout::equirect) {
    sums = std::make_unique<EquirectSums>(info, settings, tables);
    return sums;
  }
  auto geometry = TexelGeometry::create(picture.layout, info.width, info.height);
  if (!geometry) {
    geometry.error().where = picture.files.front().string();
    return std::move(geometry).error();
  }
  sums = std::make_unique<DirectionSums>(info, settings, *geometry);
  return sums;
}

// The integral over the sphere.
glm::dvec3 flux_of(const Coefficients& radiance) {
  const auto& [red, green, blue] = radiance.channels;
  return std::sqrt(4.0 * std::numbers::pi) * glm::dvec3(red[0], green[0], blue[0]);
}

glm::dvec3 vector_of(const std::array<double, 3>& rgb) { return {rgb[0], rgb[1], rgb[2]}; }

bool is_finite(const Coefficients& coefficients) {
  return std::ranges::all_of(coefficients.channels, [](const auto& channel) {
    return std::ranges::all_of(channel, [](double value) { return std::isfinite(value); });
  });
}

}  // namespace

struct PanoramaProjection::Impl {
  std::string path;
  ProjectionSettings settings;
  LaidOutPicture picture;
  std::unique_ptr<PictureSums> sums;
  std::unique_ptr<BrightTexels> bright;  // where the settings ask for them
  std::vector<AnalyticLight> lights;     // of a painted panorama, beside its pixels

  std::atomic<int> next_band{0};
  std::atomic<bool> taken{false};   // by the one worker of a panorama that cannot be shared
  std::atomic<bool> failed{false};  // by any worker: the others need not go on
  mutable std::mutex tally_mutex;   // guards what follows
  PixelTally tally;
  Seconds seconds;

  [[nodiscard]] const PictureInfo& info() const { return picture.source->info(); }
  [[nodiscard]] bool shareable() const {
    return info().band_access == BandAccess::random && sums->shareable();
  }
  void watch_bright();
  [[nodiscard]] BrightChanges change_bright();
  void tell_bright(const BrightChanges& changes, Projection& result) const;
  [[nodiscard]] int claim_band(const std::atomic<bool>& stop);
  [[nodiscard]] Status check_policy() const;
  [[nodiscard]] PixelReport report(const PictureTotals& totals) const;
  [[nodiscard]] Coefficients whole_light(Coefficients of_pixels) const;
};

// Before the first band.
void PanoramaProjection::Impl::watch_bright() {
  const BrightRange range = bright_range(settings);
  if (range.fraction == 0.0) return;
  bright = std::make_unique<BrightTexels>(range.fraction, range.floor, [this](int row, int column) {
    return sums->solid_angle(row, column);
  });
  sums->watch(bright.get());
}

// After the last band.
BrightChanges PanoramaProjection::Impl::change_bright() {
  if (!bright) return {};
  const TexelPlaces places{[this](int row, int column) { return sums->texel(row, column); },
                           {picture.layout, info().width, info().height}};
  BrightChanges changes = bright_changes(bright->brightest(), settings, places);
  sums->change(changes.changes);
  return changes;
}

// Puts what was done about clamp and sun into the report, and a replaced sun into the light.
void PanoramaProjection::Impl::tell_bright(const BrightChanges& changes, Projection& result) const {
  PixelReport& pixels = result.pixels;
  pixels.clamp_threshold = changes.clamp > 0.0 ? changes.clamp : settings.pixels.clamp;
  pixels.clamped_count += changes.clamped_count;
  for (int c = 0; c < kChannelCount; ++c) pixels.clamped_flux[c] += changes.clamped_flux[c];
  const glm::dmat3& to_rec709 = info().to_linear_rec709;
  const glm::dvec3 flux = flux_of(result.radiance);
  const glm::dvec3 clamped = to_rec709 * vector_of(pixels.clamped_flux);
  if (pixels.clamped_count > 0) {
    pixels.clamp_colour_shift = colour_distance(flux, flux + clamped);
  }
  if (!changes.sun) return;
  Sun sun = *changes.sun;
  sun.flux = to_rec709 * sun.flux;
  sun.irradiance = to_rec709 * sun.irradiance;
  const bool is_taken = settings.sun.action != SunSettings::Action::keep;
  const glm::dvec3 whole = flux + clamped + (is_taken ? sun.flux : glm::dvec3(0.0));
  sun.share = luminance(sun.flux) / luminance(whole);
  result.sun = sun;
  if (settings.sun.action != SunSettings::Action::replace) return;
  const std::array<AnalyticLight, 1> disk{sun.disk()};
  const auto put_back = [&disk](Coefficients& light) {
    const int degree = light.degree;
    light = add(std::move(light), project_lights(disk, degree));
  };
  put_back(result.radiance);
  if (result.finer) put_back(*result.finer);
}

// The next band for a worker, or -1.
int PanoramaProjection::Impl::claim_band(const std::atomic<bool>& stop) {
  if (stop || failed || next_band >= info().band_count) return -1;
  const int band = next_band++;
  return band < info().band_count ? band : -1;
}

Status PanoramaProjection::Impl::check_policy() const {
  if (tally.nonfinite_count == 0 || settings.pixels.nonfinite == PixelPolicy::NonFinite::zero) {
    return {};
  }
  // A picture of six files is told by the file and by its row there.
  const auto rows_of_file = info().height / static_cast<std::int64_t>(picture.files.size());
  const std::string& file = picture.files[tally.first_nonfinite_row / rows_of_file].string();
  const std::string row = std::to_string(tally.first_nonfinite_row % rows_of_file);
  return Error{ErrorCode::pixels,
               std::to_string(tally.nonfinite_count) +
                   (tally.nonfinite_count == 1 ? " pixel is" : " pixels are") +
                   " not finite (NaN or infinity), the first in row " + row + ", column " +
                   std::to_string(tally.first_nonfinite_column),
               file + ":" + row, "nonfinite: zero takes them as black"};
}

PixelReport PanoramaProjection::Impl::report(const PictureTotals& totals) const {
  PixelReport report;
  report.pixel_count = totals.pixel_count;
  report.nonfinite_count = tally.nonfinite_count;
  report.negative_count = tally.negative_count;
  report.clamped_count = tally.clamped_count;
  report.mean = totals.mean;
  report.clamped_flux = totals.clamped_flux;
  for (int c = 0; c < kChannelCount; ++c) {
    const int channel = info().channel_count == 1 ? 0 : c;
    // A picture without a single finite sample has no extremes.
    const bool any = tally.minimum[channel] <= tally.maximum[channel];
    report.minimum[c] = any ? tally.minimum[channel] : 0.0;
    report.maximum[c] = any ? tally.maximum[channel] : 0.0;
  }
  return report;
}

// In linear Rec.709, with the lights that pixels would blur.
Coefficients PanoramaProjection::Impl::whole_light(Coefficients of_pixels) const {
  Coefficients light = apply_matrix(std::move(of_pixels), info().to_linear_rec709);
  if (lights.empty()) return light;
  const int degree = light.degree;
  return add(std::move(light), project_lights(lights, degree));
}

PanoramaProjection::PanoramaProjection() : impl_(std::make_unique<Impl>()) {}
PanoramaProjection::~PanoramaProjection() = default;

const PictureInfo& PanoramaProjection::info() const { return impl_->info(); }

Result<std::unique_ptr<PanoramaProjection>> PanoramaProjection::open(
    const std::filesystem::path& path, const ReadOptions& options,
    const ProjectionSettings& settings, ProjectionTables& tables) {
  SHOAL_ASSIGN_OR_RETURN(picture,
                         open_picture(path, options, simd_chunk_codecs(), settings.layout));
  SHOAL_ASSIGN_OR_RETURN(sums, sums_for(picture, settings, tables));
  std::unique_ptr<PanoramaProjection> projection(new PanoramaProjection());
  Impl& impl = *projection->impl_;
  impl.path = path.string();
  impl.settings = settings;
  impl.picture = std::move(picture);
  impl.sums = std::move(sums);
  impl.watch_bright();
  return projection;
}

std::unique_ptr<PanoramaProjection> PanoramaProjection::open(PaintedPanorama panorama,
                                                             const ProjectionSettings& settings,
                                                             ProjectionTables& tables) {
  std::unique_ptr<PanoramaProjection> projection(new PanoramaProjection());
  Impl& impl = *projection->impl_;
  impl.path = panorama.name;
  impl.settings = settings;
  impl.picture = {std::move(panorama.source), Layout::equirect, {panorama.name}, {}, {}};
  impl.sums = std::make_unique<EquirectSums>(impl.info(), settings, tables);
  impl.lights = std::move(panorama.lights);
  impl.watch_bright();
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
  SHOAL_ASSIGN_OR_RETURN(reader, impl.picture.source->new_reader());
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
    impl.sums->add(*band, worker);
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
  const BrightChanges bright = impl.change_bright();
  PictureTotals totals = impl.sums->totals();
  Projection result;
  result.grid = grid_of(info());
  result.format = info().format;
  if (impl.picture.layout != Layout::equirect) {
    result.format += ", " + std::string(name_of(impl.picture.layout));
  }
  result.quadrature = totals.quadrature;
  result.solid_angle = totals.solid_angle;
  result.recognised_layout = impl.picture.recognised;
  result.warnings = info().warnings;
  std::ranges::copy(impl.picture.notes, std::back_inserter(result.warnings));
  result.pixels = impl.report(totals);
  result.radiance = impl.whole_light(std::move(totals.radiance));
  if (totals.finer) result.finer = impl.whole_light(std::move(*totals.finer));
  impl.tell_bright(bright, result);
  std::ranges::copy(warnings_of(result.pixels, impl.settings.pixels),
                    std::back_inserter(result.warnings));
  std::ranges::copy(bright.warnings, std::back_inserter(result.warnings));
  if (!is_finite(result.finer ? *result.finer : result.radiance)) {
    return Error{ErrorCode::pixels, "the sums of its pixels leave the range of numbers", impl.path,
                 "clamp: takes away what no light can be"};
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
