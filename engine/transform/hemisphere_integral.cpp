#include "transform/hemisphere_integral.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <memory>
#include <numbers>
#include <optional>
#include <string>
#include <thread>

#include "core/aligned_buffer.h"
#include "kernels/row_moments.h"
#include "sphere/gauss_legendre.h"

namespace shoal {
namespace {

using Real = long double;
constexpr Real kPi = std::numbers::pi_v<Real>;
constexpr double kTurn = 2.0 * std::numbers::pi;
constexpr int kNodesPerRow = 4;

// Integrals over some columns of one channel's radiance times cos(phi), sin(phi) and 1.
struct Arc {
  std::array<glm::dvec3, 3> of{glm::dvec3(0.0), glm::dvec3(0.0), glm::dvec3(0.0)};  // r, g, b
};

Arc operator+(const Arc& a, const Arc& b) {
  return {{a.of[0] + b.of[0], a.of[1] + b.of[1], a.of[2] + b.of[2]}};
}

Arc operator-(const Arc& a, const Arc& b) {
  return {{a.of[0] - b.of[0], a.of[1] - b.of[1], a.of[2] - b.of[2]}};
}

// An angle with its sine and cosine.
struct Angle {
  double phi = 0.0;
  double cosine = 1.0;
  double sine = 0.0;
};

// One row's radiance as a function of phi, ready to be integrated from 0.
class RowIntegrals {
 public:
  explicit RowIntegrals(int width) : width_(width), step_(kTurn / width), sums_(width + 1) {
    for (int j = 0; j <= width; ++j) {
      const Real phi = 2 * kPi * j / width;
      edges_.push_back({static_cast<double>(phi), static_cast<double>(std::cos(phi)),
                        static_cast<double>(std::sin(phi))});
    }
  }

  void set(const std::array<std::span<const float>, 3>& channels) {
    channels_ = channels;
    for (int j = 0; j < width_; ++j) sums_[j + 1] = sums_[j] + part(j, edges_[j + 1]);
  }

  [[nodiscard]] const Arc& whole() const { return sums_.back(); }

  // From one angle on to another, both in (-2 pi, 4 pi) and less than a turn apart.
  [[nodiscard]] Arc between(Angle from, Angle to) const {
    const bool wraps_below = from.phi < 0.0;
    const bool wraps_above = to.phi >= kTurn;
    if (wraps_below) from.phi += kTurn;
    if (wraps_above) to.phi -= kTurn;
    const Arc difference = up_to(to) - up_to(from);
    return wraps_below || wraps_above ? difference + whole() : difference;
  }

 private:
  // From the left edge of column j to an angle within it.
  [[nodiscard]] Arc part(int j, const Angle& to) const {
    const Angle& from = edges_[j];
    const glm::dvec3 factors(to.sine - from.sine, from.cosine - to.cosine, to.phi - from.phi);
    Arc arc;
    for (int c = 0; c < 3; ++c) arc.of[c] = static_cast<double>(channels_[c][j]) * factors;
    return arc;
  }

  [[nodiscard]] Arc up_to(const Angle& to) const {
    const int j = std::clamp(static_cast<int>(to.phi / step_), 0, width_ - 1);
    return sums_[j] + part(j, to);
  }

  int width_;
  double step_;
  std::vector<Angle> edges_;  // (width + 1)
  std::vector<Arc> sums_;     // (width + 1)
  std::array<std::span<const float>, 3> channels_;
};

// A unit direction in the terms of the integral.
struct Facing {
  double across = 0.0;  // |(x, y)|
  double up = 0.0;      // z
  Angle azimuth;        // phi in [0, 2 pi)
};

Facing facing(const glm::dvec3& n) {
  Facing result;
  result.across = static_cast<double>(std::sqrt(Real{n.x} * n.x + Real{n.y} * n.y));
  result.up = n.z;
  if (result.across == 0.0) return result;
  const Real phi = std::atan2(Real{n.y}, Real{n.x});
  result.azimuth = {static_cast<double>(phi < 0 ? phi + 2 * kPi : phi), n.x / result.across,
                    n.y / result.across};
  return result;
}

// The part of a circle of latitude in front of a surface, times the cosine of its incidence.
glm::dvec3 lit_by_circle(const RowIntegrals& row, const Facing& n, double cos_theta,
                         double sin_theta) {
  const double across = n.across * sin_theta;
  const double up = n.up * cos_theta;
  if (across <= -up) return glm::dvec3(0.0);
  Arc arc = row.whole();
  if (across > up) {
    // Half the arc's length, which the angle where the incidence is grazing tells.
    const double cosine = -up / across;
    const double sine = std::sqrt((1.0 - cosine) * (1.0 + cosine));
    const double half = std::acos(cosine);
    const Angle& middle = n.azimuth;
    arc = row.between({middle.phi - half, middle.cosine * cosine + middle.sine * sine,
                       middle.sine * cosine - middle.cosine * sine},
                      {middle.phi + half, middle.cosine * cosine - middle.sine * sine,
                       middle.sine * cosine + middle.cosine * sine});
  }
  const glm::dvec3 incidence(across * n.azimuth.cosine, across * n.azimuth.sine, up);
  return {glm::dot(arc.of[0], incidence), glm::dot(arc.of[1], incidence),
          glm::dot(arc.of[2], incidence)};
}

// One thread's share of the directions.
class HemisphereWorker {
 public:
  HemisphereWorker(const PictureInfo& info, std::span<const glm::dvec3> directions,
                   std::span<glm::dvec3> irradiance)
      : info_(info), irradiance_(irradiance), integrals_(info.width) {
    for (const glm::dvec3& direction : directions) facings_.push_back(facing(direction));
    const GaussRule rule = gauss_legendre(kNodesPerRow);
    nodes_.assign(rule.nodes.begin(), rule.nodes.end());
    weights_.assign(rule.weights.begin(), rule.weights.end());
  }

  void add_row(const RowBand& band, int row, const PixelPolicy& policy) {
    const auto width = static_cast<std::size_t>(band.width);
    samples_.resize_uninitialised(kMaxChannels * width);
    PolicyRow treated;
    treated.channel_count = band.channel_count;
    for (int c = 0; c < band.channel_count; ++c) {
      treated.channels[c] = samples_.span().subspan(c * width, width);
      kernels::widen_row(band, row, c, scratch_, treated.channels[c].data());
    }
    const int number = band.row_begin + row;
    apply_pixel_policy(policy, treated, {number, 0, 0, 1}, tally_, [](int, std::size_t, double) {});
    std::array<std::span<const float>, 3> channels;
    for (int c = 0; c < 3; ++c) {
      const std::span<float> samples = treated.channels[band.channel_count == 1 ? 0 : c];
      if (info_.samples_reversed && c < band.channel_count) std::ranges::reverse(samples);
      channels[c] = samples;
    }
    integrals_.set(channels);
    integrate(number);
  }

  [[nodiscard]] std::int64_t nonfinite_count() const { return tally_.nonfinite_count; }

 private:
  void integrate(int row) {
    const Real half = kPi / (2 * info_.height);
    for (int k = 0; k < kNodesPerRow; ++k) {
      const Real theta = kPi * (2 * row + 1) / (2 * info_.height) + half * nodes_[k];
      const auto cosine = static_cast<double>(std::cos(theta));
      const auto sine = static_cast<double>(std::sin(theta));
      const auto weight = static_cast<double>(half * weights_[k] * sine);
      for (std::size_t i = 0; i < facings_.size(); ++i) {
        irradiance_[i] += weight * lit_by_circle(integrals_, facings_[i], cosine, sine);
      }
    }
  }

  const PictureInfo& info_;
  std::span<glm::dvec3> irradiance_;
  RowIntegrals integrals_;
  std::vector<Facing> facings_;
  std::vector<Real> nodes_, weights_;
  PixelTally tally_;
  AlignedBuffer<float> samples_;
  kernels::RowMomentScratch scratch_;
};

Status check_picture(const PictureInfo& info) {
  if (info.scan_axis == ScanAxis::rows && info.positions == PixelPositions::centers) return {};
  return Error{ErrorCode::unsupported,
               "brute force takes pictures stored in rows, with no pixels on the poles", "",
               "leave --brute-force out"};
}

Status work_through(const PanoramaSource& source, const HemisphereSettings& settings,
                    const std::atomic<bool>& stop, HemisphereWorker& worker) {
  SHOAL_ASSIGN_OR_RETURN(reader, source.new_reader());
  const PictureInfo& info = source.info();
  std::int64_t rows_done = 0;
  for (int index = 0; index < info.band_count; ++index) {
    SHOAL_ASSIGN_OR_RETURN(band, reader->read(index));
    for (int row = 0; row < band.row_count(); ++row) {
      if (stop) return Error{ErrorCode::interrupted, "interrupted", "", ""};
      worker.add_row(band, row, settings.pixels);
      ++rows_done;
      if (settings.progress) settings.progress(static_cast<double>(rows_done) / info.height);
    }
  }
  if (worker.nonfinite_count() == 0 || settings.pixels.nonfinite == PixelPolicy::NonFinite::zero) {
    return {};
  }
  return Error{ErrorCode::pixels,
               std::to_string(worker.nonfinite_count()) + " pixels are not finite", "",
               "nonfinite: zero takes them as black"};
}

}  // namespace

Result<std::vector<glm::dvec3>> integrate_hemispheres(const PanoramaSource& source,
                                                      std::span<const glm::dvec3> directions,
                                                      const HemisphereSettings& settings,
                                                      const std::atomic<bool>& stop) {
  const PictureInfo& info = source.info();
  SHOAL_RETURN_IF_ERROR(check_picture(info));
  std::vector<glm::dvec3> irradiance(directions.size(), glm::dvec3(0.0));
  const auto threads = static_cast<std::size_t>(std::max(1, settings.threads));
  std::vector<Status> statuses(threads);
  {
    std::vector<std::jthread> workers;
    for (std::size_t t = 0; t < threads; ++t) {
      const std::size_t begin = directions.size() * t / threads;
      const std::size_t count = directions.size() * (t + 1) / threads - begin;
      workers.emplace_back([&, t, begin, count] {
        HemisphereWorker worker(info, directions.subspan(begin, count),
                                std::span(irradiance).subspan(begin, count));
        HemisphereSettings own = settings;
        if (t > 0) own.progress = nullptr;
        statuses[t] = work_through(source, own, stop, worker);
      });
    }
  }
  for (Status& status : statuses) SHOAL_RETURN_IF_ERROR(std::move(status));
  for (glm::dvec3& value : irradiance) value = info.to_linear_rec709 * value;
  return irradiance;
}

}  // namespace shoal
