#include "batch/store_quality.h"

#include <cmath>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "batch/store_numbers.h"

namespace shoal {
namespace {

// NULL in the store.
constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

double or_none(const std::optional<double>& figure) { return figure.value_or(kNone); }

std::optional<double> figure(const SqlStatement& row, int column) {
  const double value = row.real(column);
  return std::isnan(value) ? std::nullopt : std::optional<double>(value);
}

glm::dvec3 triple(const SqlStatement& row, int column) {
  return {row.real(column), row.real(column + 1), row.real(column + 2)};
}

}  // namespace

const char* const kInsertQuality =
    "INSERT INTO quality VALUES"
    " (?,?,?,?,?,?,?,?,?,?,?,?,?,?,?,?,?,?,?,?,?,?,?,?,?,?,?,?,?,?,?,?)";

const char* const kSelectQuality = "SELECT * FROM quality WHERE item = ? ORDER BY position";

Status write_quality(SqlStatement& insert, std::int64_t item, std::int64_t position,
                     const VariantQuality& variant) {
  const LightQuality& quality = variant.quality;
  const bool has_error = quality.error.has_value();
  const IrradianceError error = quality.error.value_or(IrradianceError{});
  const glm::dvec3 worst = has_error ? error.direction : glm::dvec3(kNone);
  const bool has_least = quality.least.has_value();
  const LeastIrradiance least = quality.least.value_or(LeastIrradiance{});
  const glm::dvec3 darkest = has_least ? least.direction : glm::dvec3(kNone);
  const bool has_light = quality.dominant.has_value();
  const auto light = quality.dominant.value_or(LightQuality::Dominant{});
  const glm::dvec3 towards = has_light ? light.direction : glm::dvec3(kNone);
  const glm::dvec3 colour = has_light ? light.irradiance : glm::dvec3(kNone);
  return insert.run(
      item, position, variant.variant, quality.degree, has_error ? error.degree : kNone,
      has_error ? error.relative_rms : kNone, has_error ? error.maximum : kNone, worst.x, worst.y,
      worst.z, has_least ? least.value : kNone, darkest.x, darkest.y, darkest.z,
      has_least ? least.channel : kNone, quality.negative_fraction, or_none(quality.contrast),
      quality.mean.r, quality.mean.g, quality.mean.b, or_none(quality.directionality), towards.x,
      towards.y, towards.z, colour.r, colour.g, colour.b, has_light ? light.energy_share : kNone,
      or_none(quality.key_temperature), or_none(quality.fill_temperature),
      joined(quality.energy_shares), joined(quality.window_gains));
}

VariantQuality read_quality(const SqlStatement& row) {
  VariantQuality variant{row.text(2), {}};
  LightQuality& quality = variant.quality;
  quality.degree = static_cast<int>(row.integer(3));
  if (figure(row, 4)) {
    quality.error = {static_cast<int>(row.integer(4)), row.real(5), row.real(6), triple(row, 7)};
  }
  if (figure(row, 10)) {
    quality.least = {row.real(10), triple(row, 11), static_cast<int>(row.integer(14))};
  }
  quality.negative_fraction = row.real(15);
  quality.contrast = figure(row, 16);
  quality.mean = triple(row, 17);
  quality.directionality = figure(row, 20);
  if (figure(row, 21)) quality.dominant = {triple(row, 21), triple(row, 24), row.real(27)};
  quality.key_temperature = figure(row, 28);
  quality.fill_temperature = figure(row, 29);
  quality.energy_shares = split(row.text(30));
  quality.window_gains = split(row.text(31));
  return variant;
}

}  // namespace shoal
