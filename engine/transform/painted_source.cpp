#include "transform/painted_source.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>
#include <optional>
#include <utility>

#include "core/aligned_buffer.h"
#include "sphere/coefficients.h"

namespace shoal {
namespace {

constexpr double kPi = std::numbers::pi;
// Where a texel's function is sampled, from -1/2 to 1/2 of its sides: the two nodes of
// Gauss-Legendre, exact for cubics.
constexpr int kSamples = 2;
constexpr std::array<double, kSamples> kOffsets = {-std::numbers::inv_sqrt3 / 2.0,
                                                   std::numbers::inv_sqrt3 / 2.0};
constexpr int kRowsPerBand = 16;  // a wish of the caller is none: rows are painted one by one

// Samples a side of a texel on the edge of a disk: so many a radius, within bounds that keep great
// disks from costing and tiny ones from taking for ever.
constexpr double kSamplesPerRadius = 64.0;
constexpr int kMinEdgeSamples = 16;
constexpr int kMaxEdgeSamples = 1024;

struct Angle {
  double cosine = 1.0;
  double sine = 0.0;
};

Angle angle_of(double radians) { return {std::cos(radians), std::sin(radians)}; }

glm::dvec3 direction_of(const Angle& theta, const Angle& phi) {
  return {theta.sine * phi.cosine, theta.sine * phi.sine, theta.cosine};
}

// A disk with what deciding about texels needs of it.
struct PaintedDisk {
  glm::dvec3 axis;
  double theta = 0.0;  // of the axis
  double phi = 0.0;    // in [0, 2 pi)
  double radius = 0.0;
  double chord_squared = 0.0;  // within it is who is no further than this from the axis
  double solid_angle = 0.0;
  glm::dvec3 radiance;

  explicit PaintedDisk(const DiskLight& light)
      : axis(glm::normalize(light.direction)),
        theta(std::atan2(std::hypot(axis.x, axis.y), axis.z)),
        phi(std::atan2(axis.y, axis.x)),
        radius(light.angular_radius),
        radiance(light.radiance) {
    if (phi < 0.0) phi += 2.0 * kPi;
    const double half_sine = std::sin(radius / 2.0);
    chord_squared = 4.0 * half_sine * half_sine;
    solid_angle = kPi * chord_squared;
  }

  [[nodiscard]] bool holds(const glm::dvec3& direction) const {
    const glm::dvec3 chord = direction - axis;
    return glm::dot(chord, chord) <= chord_squared;
  }
  [[nodiscard]] double angle_to(const glm::dvec3& direction) const {
    return 2.0 * std::asin(std::min(1.0, glm::length(direction - axis) / 2.0));
  }
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
    for (const DiskLight& disk : painting_.disks) disks_.emplace_back(disk);
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
  void add_disk(int row, const PaintedDisk& disk, std::vector<glm::dvec3>& colours) const;
  [[nodiscard]] double edge_share(int row, int column, const PaintedDisk& disk) const;

  [[nodiscard]] double texel_solid_angle(int row) const {
    return column_step_ * (std::cos(row_step_ * row) - std::cos(row_step_ * (row + 1)));
  }

  Painting painting_;
  PictureInfo info_;
  double row_step_;
  double column_step_;
  std::vector<PaintedDisk> disks_;
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

// The share of a texel that lies in the disk.
double PaintedSource::edge_share(int row, int column, const PaintedDisk& disk) const {
  const double wanted = kSamplesPerRadius * std::max(row_step_, column_step_) / disk.radius;
  const int count = static_cast<int>(
      std::clamp(std::ceil(wanted), double{kMinEdgeSamples}, double{kMaxEdgeSamples}));
  std::vector<Angle> phis(count);
  for (int j = 0; j < count; ++j) {
    phis[j] = angle_of(column_step_ * (column + (j + 0.5) / count));
  }
  double within = 0.0;
  double all = 0.0;
  for (int i = 0; i < count; ++i) {
    const Angle theta = angle_of(row_step_ * (row + (i + 0.5) / count));
    int hits = 0;
    for (const Angle& phi : phis) hits += disk.holds(direction_of(theta, phi)) ? 1 : 0;
    within += theta.sine * hits;
    all += theta.sine * count;
  }
  return within / all;
}

void PaintedSource::add_disk(int row, const PaintedDisk& disk,
                             std::vector<glm::dvec3>& colours) const {
  const double step = std::max(row_step_, column_step_);
  if (disk.radius < step / 16.0) {
    const int height = painting_.height;
    if (std::min(static_cast<int>(disk.theta / row_step_), height - 1) != row) return;
    const int column = std::min(static_cast<int>(disk.phi / column_step_), painting_.width - 1);
    colours[column] += disk.radiance * (disk.solid_angle / texel_solid_angle(row));
    return;
  }
  // No point of a texel is further from its centre than this: half a row down, half a column along.
  const double reach = (row_step_ + column_step_) / 2.0;
  const double theta = row_step_ * (row + 0.5);
  if (std::abs(theta - disk.theta) > disk.radius + reach) return;
  const Angle row_angle = angle_of(theta);
  for (int column = 0; column < painting_.width; ++column) {
    const Angle phi = angle_of(column_step_ * (column + 0.5));
    const double angle = disk.angle_to(direction_of(row_angle, phi));
    if (angle - reach > disk.radius) continue;
    const double share = angle + reach < disk.radius ? 1.0 : edge_share(row, column, disk);
    colours[column] += share * disk.radiance;
  }
}

void PaintedSource::paint_row(int row, std::vector<glm::dvec3>& row_colours,
                              const std::array<float*, kChannelCount>& planes) const {
  row_colours.assign(painting_.width, glm::dvec3(0.0));
  if (painting_.radiance) add_function(row, row_colours);
  for (const PaintedDisk& disk : disks_) add_disk(row, disk, row_colours);
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

Result<Painting> painting_of(std::span<const AnalyticLight> lights, int width, int height) {
  Painting painting{"painted lights", width, height, {}, {}};
  std::vector<PaintableLight> smooth;
  for (const AnalyticLight& light : lights) {
    const std::optional<PaintableLight> one = paintable(light);
    if (!one) {
      return Error{ErrorCode::usage, "a directional light has no picture", "",
                   "a disk of a small radius has one"};
    }
    if (const auto* disk = std::get_if<DiskLight>(&*one)) {
      painting.disks.push_back(*disk);
    } else {
      smooth.push_back(*one);
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
