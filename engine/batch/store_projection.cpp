#include "batch/store_projection.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cstring>
#include <string>
#include <utility>
#include <vector>

namespace shoal {
namespace {

static_assert(std::endian::native == std::endian::little,
              "coefficients are stored as they lie in memory, and the schema says little-endian");

std::string_view name_of(Sampling sampling) {
  return sampling == Sampling::centers ? "centers" : "endpoints";
}

std::vector<double> flattened(const Coefficients& coefficients) {
  std::vector<double> values;
  for (const auto& channel : coefficients.channels) {
    values.insert(values.end(), channel.begin(), channel.end());
  }
  return values;
}

std::string lines_of(const std::vector<std::string>& warnings) {
  std::string text;
  for (const auto& warning : warnings) text += warning + '\n';
  return text;
}

std::vector<std::string> split_lines(const std::string& text) {
  std::vector<std::string> lines;
  for (std::size_t begin = 0, end; begin < text.size(); begin = end + 1) {
    end = std::min(text.find('\n', begin), text.size());
    lines.push_back(text.substr(begin, end - begin));
  }
  return lines;
}

std::array<double, 3> triple(const SqlStatement& row, int column) {
  return {row.real(column), row.real(column + 1), row.real(column + 2)};
}

Sun read_sun(const SqlStatement& row, int column) {
  const auto vector = [&](int first) {
    const auto [x, y, z] = triple(row, column + first);
    return glm::dvec3(x, y, z);
  };
  Sun sun;
  sun.direction = vector(0);
  sun.angular_radius = row.real(column + 3);
  sun.solid_angle = row.real(column + 4);
  sun.irradiance = vector(5);
  sun.flux = vector(8);
  sun.level = row.real(column + 11);
  sun.share = row.real(column + 12);
  sun.texel_count = row.integer(column + 13);
  return sun;
}

Error damaged(std::string what) {
  return Error{ErrorCode::malformed, "the store is damaged: " + std::move(what), "",
               "delete it and run again: every panorama is then processed anew"};
}

Result<Coefficients> read_coefficients(std::int64_t degree, std::span<const std::byte> blob) {
  const auto count = degree < 0 || degree > kMaxDegree
                         ? std::size_t{0}
                         : static_cast<std::size_t>(coefficient_count(static_cast<int>(degree)));
  if (count == 0 || blob.size() != kChannelCount * count * sizeof(double)) {
    return damaged("a projection of degree " + std::to_string(degree) + " has " +
                   std::to_string(blob.size()) + " bytes of coefficients");
  }
  Coefficients coefficients(static_cast<int>(degree));
  for (auto& channel : coefficients.channels) {
    std::memcpy(channel.data(), blob.data(), count * sizeof(double));
    blob = blob.subspan(count * sizeof(double));
  }
  return coefficients;
}

}  // namespace

const char* const kInsertProjection =
    "INSERT INTO projections VALUES (?,?,?,?,?,?,?,?,?,?,?,?,?,?,?,?,?,?,?,?,?,?,?,?,?,?,?,?,?,?)";

const char* const kSelectProjectionByName =
    "SELECT projections.*, suns.* FROM projections JOIN items ON items.id = projections.item"
    " LEFT JOIN suns ON suns.item = projections.item WHERE name = ?";

const char* const kSelectProjectionByItem =
    "SELECT projections.*, suns.* FROM projections LEFT JOIN suns ON suns.item = projections.item"
    " WHERE projections.item = ?";

const char* const kInsertSun = "INSERT INTO suns VALUES (?,?,?,?,?,?,?,?,?,?,?,?,?,?,?)";

Status write_sun(SqlStatement& insert, std::int64_t item, const Sun& sun) {
  return insert.run(item, sun.direction.x, sun.direction.y, sun.direction.z, sun.angular_radius,
                    sun.solid_angle, sun.irradiance.r, sun.irradiance.g, sun.irradiance.b,
                    sun.flux.r, sun.flux.g, sun.flux.b, sun.level, sun.share, sun.texel_count);
}

Status write_projection(SqlStatement& insert, std::int64_t item, const Projection& projection) {
  const PixelReport& pixels = projection.pixels;
  const auto& low = pixels.minimum;
  const auto& high = pixels.maximum;
  const auto& mean = pixels.mean;
  const auto& flux = pixels.clamped_flux;
  const std::vector<double> radiance = flattened(projection.radiance);
  const std::vector<double> finer =
      projection.finer ? flattened(*projection.finer) : std::vector<double>();
  const std::string warnings = lines_of(projection.warnings);
  return insert.run(
      item, projection.format, projection.grid.width, projection.grid.height,
      name_of(projection.grid.sampling), name_of(projection.quadrature), projection.solid_angle,
      pixels.pixel_count, pixels.nonfinite_count, pixels.negative_count, pixels.clamped_count,
      low[0], low[1], low[2], high[0], high[1], high[2], mean[0], mean[1], mean[2], flux[0],
      flux[1], flux[2], warnings, projection.radiance.degree, std::as_bytes(std::span(radiance)),
      projection.finer ? projection.finer->degree : 0, std::as_bytes(std::span(finer)),
      pixels.clamp_threshold, pixels.clamp_colour_shift);
}

Result<Projection> read_projection(const SqlStatement& row) {
  Projection projection;
  projection.format = row.text(1);
  projection.grid.width = static_cast<int>(row.integer(2));
  projection.grid.height = static_cast<int>(row.integer(3));
  const bool centers = row.text(4) == name_of(Sampling::centers);
  projection.grid.sampling = centers ? Sampling::centers : Sampling::endpoints;
  const auto quadrature = parse_quadrature(row.text(5));
  if (!quadrature) return damaged(quadrature.error().what);
  projection.quadrature = *quadrature;
  projection.solid_angle = row.real(6);
  projection.pixels.pixel_count = row.integer(7);
  projection.pixels.nonfinite_count = row.integer(8);
  projection.pixels.negative_count = row.integer(9);
  projection.pixels.clamped_count = row.integer(10);
  projection.pixels.minimum = triple(row, 11);
  projection.pixels.maximum = triple(row, 14);
  projection.pixels.mean = triple(row, 17);
  projection.pixels.clamped_flux = triple(row, 20);
  projection.warnings = split_lines(row.text(23));
  SHOAL_ASSIGN_OR_RETURN(radiance, read_coefficients(row.integer(24), row.blob(25)));
  projection.radiance = std::move(radiance);
  if (const std::int64_t degree = row.integer(26); degree > 0) {
    SHOAL_ASSIGN_OR_RETURN(finer, read_coefficients(degree, row.blob(27)));
    projection.finer = std::move(finer);
  }
  projection.pixels.clamp_threshold = row.real(28);
  projection.pixels.clamp_colour_shift = row.real(29);
  // Items count from 1; without a sun this is NULL.
  if (row.integer(30) != 0) projection.sun = read_sun(row, 31);
  return projection;
}

}  // namespace shoal
