#include "transform/painted_source.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>
#include <variant>

#include "core/aligned_buffer.h"
#include "sphere/coefficients.h"
#include "sphere/disk_coverage.h"

namespace shoal {
namespace {

constexpr double kPi = std::numbers::pi;
// Where a texel's function is sampled, from -1/2 to 1/2 of its sides: the two nodes of
// Gauss-Legendre, exact for cubics.
constexpr int kSamples = 2;
constexpr std::array<double, kSamples> kOffsets = {-std::numbers::inv_sqrt3 / 2.0,
                                                   std::numbers::inv_sqrt3 / 2.0};
constexpr int kRowsPerBand = 16;  // a wish of the caller is none: rows are painted one by one

struct Angle {
  double cosine = 1.0;
  double sine = 0.0;
};

Angle angle_of(double radians) { return {std::cos(radians), std::sin(radians)}; }

glm::dvec3 direction_of(const Angle& theta, const Angle& phi) {
  return {theta.sine * phi.cosine, theta.sine * phi.sine, theta.cosine};
}

// A disk with what it covers.
struct PaintedDisk {
  DiskCoverage coverage;
  glm::dvec3 radiance;
};

// A directional light's radiance in one texel.
struct Spot {
  int row = 0;
  int column = 0;
  glm::dvec3 radiance;
};

class PaintedSource final : public PanoramaSource {
 public:
  explicit PaintedSource(Painting painting)
      : painting_(std::move(painting)),
        row_step_(kPi / painting_.height),
        column_step_(2.0 * kPi / painting_.width) {
    info_.format = painting_.format;
    info_.width = painting_.width;
    info_.height = painting_.height;
    info_.rows_per_band = kRowsPerBand;
    info_.band_count = (painting_.height + kRowsPerBand - 1) / kRowsPerBand;
    for (const DiskLight& disk : painting_.disks) {
      disks_.push_back({DiskCoverage(disk, info_.width, info_.height), disk.radiance});
    }
    for (const DirectionalLight& light : painting_.directional) add_spots(light);
    columns_.resize(static_cast<std::size_t>(painting_.width) * kSamples);
    for (int j = 0; j < painting_.width; ++j) {
      for (int k = 0; k < kSamples; ++k) {
        columns_[kSamples * j + k] = angle_of(column_step_ * (j + 0.5 + kOffsets[k]));
      }
    }
  }

  [[nodiscard]] const PictureInfo& info() const override { return info_; }
  [[nodiscard]] Result<std::unique_ptr<BandReader>> new_reader() const override;

  // One row; each plane holds `width` floats. `row_colours` is scratch.
  void paint_row(int row, std::vector<glm::dvec3>& row_colours,
                 const std::array<float*, kChannelCount>& planes) const;

 private:
  void add_function(int row, std::vector<glm::dvec3>& colours) const;
  [[nodiscard]] double mean_theta(int row) const;
  void add_spots(const DirectionalLight& light);
  void add_spots_of_row(int row, double phi, const glm::dvec3& irradiance);

  [[nodiscard]] double texel_solid_angle(int row) const {
    // cos(a) - cos(b), but without the loss of digits near the poles.
    return column_step_ * 2.0 * std::sin(row_step_ * (row + 0.5)) * std::sin(row_step_ / 2.0);
  }

  Painting painting_;
  PictureInfo info_;
  double row_step_;
  double column_step_;
  std::vector<PaintedDisk> disks_;
  std::vector<Spot> spots_;
  std::vector<Angle> columns_;  // of the samples, kSamples a texel
};

void PaintedSource::add_function(int row, std::vector<glm::dvec3>& colours) const {
  std::array<Angle, kSamples> thetas;
  double sines = 0.0;
  for (int k = 0; k < kSamples; ++k) {
    thetas[k] = angle_of(row_step_ * (row + 0.5 + kOffsets[k]));
    sines += thetas[k].sine;
  }
  for (const Angle& theta : thetas) {
    const double weight = theta.sine / (sines * kSamples);
    for (std::size_t j = 0; j < columns_.size(); ++j) {
      colours[j / kSamples] += weight * painting_.radiance(direction_of(theta, columns_[j]));
    }
  }
}

// The mean of theta over a texel of a row. Over a pole lies the first row again.
double PaintedSource::mean_theta(int row) const {
  if (row < 0) return -mean_theta(-1 - row);
  if (row >= painting_.height) return 2.0 * kPi - mean_theta(2 * painting_.height - 1 - row);
  const double half = row_step_ / 2.0;
  const double centre = row_step_ * (row + 0.5);
  return centre + (1.0 - half / std::tan(half)) / std::tan(centre);
}

void PaintedSource::add_spots(const DirectionalLight& light) {
  const glm::dvec3& axis = light.direction;
  const double theta = std::atan2(std::hypot(axis.x, axis.y), axis.z);
  const double phi = std::atan2(axis.y, axis.x);
  int above = static_cast<int>(std::floor(theta / row_step_ - 0.5));
  if (mean_theta(above) > theta) --above;
  if (mean_theta(above + 1) < theta) ++above;
  const double way = mean_theta(above + 1) - mean_theta(above);
  for (const int row : {above, above + 1}) {
    const int seen = std::clamp(row, 0, painting_.height - 1);
    const double share = 1.0 - std::abs(theta - mean_theta(row)) / way;
    add_spots_of_row(seen, seen == row ? phi : phi + kPi, share * light.irradiance);
  }
}

void PaintedSource::add_spots_of_row(int row, double phi, const glm::dvec3& irradiance) {
  const int width = painting_.width;
  const double place = phi / column_step_ - 0.5;
  const double left = std::floor(place);
  for (const double column : {left, left + 1.0}) {
    const double share = 1.0 - std::abs(place - column);
    const int seen = (static_cast<int>(column) % width + width) % width;
    spots_.push_back({row, seen, share / texel_solid_angle(row) * irradiance});
  }
}

void PaintedSource::paint_row(int row, std::vector<glm::dvec3>& row_colours,
                              const std::array<float*, kChannelCount>& planes) const {
  row_colours.assign(painting_.width, glm::dvec3(0.0));
  if (painting_.radiance) add_function(row, row_colours);
  for (const PaintedDisk& disk : disks_) {
    const std::vector<double> shares = disk.coverage.shares(row);
    for (std::size_t j = 0; j < shares.size(); ++j) row_colours[j] += shares[j] * disk.radiance;
  }
  for (const Spot& spot : spots_) {
    if (spot.row == row) row_colours[spot.column] += spot.radiance;
  }
  for (int c = 0; c < kChannelCount; ++c) {
    for (int j = 0; j < painting_.width; ++j) planes[c][j] = static_cast<float>(row_colours[j][c]);
  }
}

class PaintedReader final : public BandReader {
 public:
  explicit PaintedReader(const PaintedSource& source) : source_(source) {
    const auto band = static_cast<std::size_t>(source.info().width) * kRowsPerBand;
    samples_.resize_uninitialised(kChannelCount * band);
  }

  Result<RowBand> read(int index) override {
    const auto width = static_cast<std::size_t>(source_.info().width);
    RowBand band;
    band.row_begin = index * kRowsPerBand;
    band.row_end = std::min(band.row_begin + kRowsPerBand, source_.info().height);
    band.width = source_.info().width;
    std::array<float*, kChannelCount> planes;
    for (int c = 0; c < kChannelCount; ++c) {
      planes[c] = samples_.data() + c * kRowsPerBand * width;
      band.channels[c] = {reinterpret_cast<const std::byte*>(planes[c]),
                          static_cast<std::ptrdiff_t>(width * sizeof(float)), SampleType::float32};
    }
    for (int row = band.row_begin; row < band.row_end; ++row) {
      const std::size_t offset = (row - band.row_begin) * width;
      source_.paint_row(row, colours_,
                        {planes[0] + offset, planes[1] + offset, planes[2] + offset});
    }
    return band;
  }

 private:
  const PaintedSource& source_;
  AlignedBuffer<float> samples_;  // (3, kRowsPerBand, width)
  std::vector<glm::dvec3> colours_;
};

Result<std::unique_ptr<BandReader>> PaintedSource::new_reader() const {
  return std::unique_ptr<BandReader>(std::make_unique<PaintedReader>(*this));
}

}  // namespace

Result<std::unique_ptr<PanoramaSource>> paint(Painting painting) {
  const auto is_side = [](int side) { return side >= 1 && side <= kMaxSide; };
  if (!is_side(painting.width) || !is_side(painting.height) ||
      std::int64_t{painting.width} * painting.height > kMaxPixels) {
    return Error{ErrorCode::usage,
                 "a picture of " + std::to_string(painting.width) + " x " +
                     std::to_string(painting.height) + " cannot be painted",
                 "", "such as 1024 x 512"};
  }
  return std::unique_ptr<PanoramaSource>(std::make_unique<PaintedSource>(std::move(painting)));
}

Painting painting_of(std::span<const AnalyticLight> lights, int width, int height) {
  Painting painting{"painted lights", width, height, {}, {}, {}};
  std::vector<PaintableLight> smooth;
  for (const AnalyticLight& light : lights) {
    if (const auto* disk = std::get_if<DiskLight>(&light)) {
      painting.disks.push_back(*disk);
    } else if (const auto* directional = std::get_if<DirectionalLight>(&light)) {
      painting.directional.push_back(*directional);
    } else {
      smooth.push_back(*paintable(light));
    }
  }
  if (smooth.empty()) return painting;
  painting.radiance = [smooth = std::move(smooth)](const glm::dvec3& direction) {
    glm::dvec3 sum(0.0);
    for (const PaintableLight& light : smooth) sum += radiance_at(light, direction);
    return sum;
  };
  return painting;
}

Status write_picture(const PanoramaSource& source, const std::filesystem::path& path,
                     const MapFile& file) {
  SHOAL_ASSIGN_OR_RETURN(reader, source.new_reader());
  SHOAL_ASSIGN_OR_RETURN(writer, MapWriter::create(path, file));
  for (int index = 0; index < source.info().band_count; ++index) {
    SHOAL_ASSIGN_OR_RETURN(band, reader->read(index));
    std::array<const float*, kChannelCount> planes;
    for (int c = 0; c < kChannelCount; ++c) {
      planes[c] = reinterpret_cast<const float*>(band.channels[c].data);
    }
    const auto stride = band.channels[0].row_stride / static_cast<std::ptrdiff_t>(sizeof(float));
    SHOAL_RETURN_IF_ERROR(writer->write_rows(planes, stride, band.row_count()));
  }
  return writer->commit();
}

}  // namespace shoal
