#include "output/quality_table.h"

#include <fmt/format.h>

#include <cmath>
#include <glm/mat3x3.hpp>
#include <optional>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include "output/text_quoting.h"

namespace shoal {
namespace {

using Figure = std::optional<double>;
struct Field {
  std::string_view name;
  std::variant<std::string, std::int64_t, Figure, std::vector<double>> value;
};

constexpr std::string_view kXyz[] = {"dominant_x", "dominant_y", "dominant_z"};
constexpr std::string_view kRgb[] = {"dominant_r", "dominant_g", "dominant_b"};
constexpr std::string_view kMean[] = {"mean_r", "mean_g", "mean_b"};

void add_dominant(const QualityRecord& record, std::vector<Field>& fields) {
  const auto& dominant = record.quality.dominant;
  fields.push_back({"directionality", record.quality.directionality});
  const glm::dvec3 direction =
      dominant ? native_to_frame(record.frame) * dominant->direction : glm::dvec3(0.0);
  for (int i = 0; i < 3; ++i) {
    fields.push_back({kXyz[i], dominant ? Figure(direction[i]) : Figure()});
  }
  for (int i = 0; i < 3; ++i) {
    fields.push_back({kRgb[i], dominant ? Figure(dominant->irradiance[i]) : Figure()});
  }
  fields.push_back({"dominant_energy", dominant ? Figure(dominant->energy_share) : Figure()});
}

// Every column in its order.
std::vector<Field> fields_of(const QualityRecord& record, VariantColumn variant) {
  const LightQuality& quality = record.quality;
  const auto& error = quality.error;
  std::vector<Field> fields;
  fields.push_back({"panorama", record.panorama});
  if (variant == VariantColumn::present) fields.push_back({"variant", record.variant});
  fields.push_back({"degree", std::int64_t{quality.degree}});
  fields.push_back({"error_degree", error ? Figure(error->degree) : Figure()});
  fields.push_back({"rms_error", error ? Figure(error->relative_rms) : Figure()});
  fields.push_back({"max_error", error ? Figure(error->maximum) : Figure()});
  fields.push_back({"minimum_irradiance", quality.least ? Figure(quality.least->value) : Figure()});
  fields.push_back({"negative_fraction", Figure(quality.negative_fraction)});
  fields.push_back({"contrast", quality.contrast});
  for (int c = 0; c < 3; ++c) fields.push_back({kMean[c], Figure(quality.mean[c])});
  add_dominant(record, fields);
  fields.push_back({"key_temperature", quality.key_temperature});
  fields.push_back({"fill_temperature", quality.fill_temperature});
  fields.push_back({"energy_shares", quality.energy_shares});
  fields.push_back({"window_gains", quality.window_gains});
  fields.push_back({"nonfinite_pixels", record.nonfinite_pixels});
  fields.push_back({"negative_pixels", record.negative_pixels});
  fields.push_back({"clamped_pixels", record.clamped_pixels});
  return fields;
}

std::string number(double value) { return fmt::format("{:.17g}", value); }

struct CsvText {
  std::string operator()(const std::string& text) const { return csv_quoted(text); }
  std::string operator()(std::int64_t count) const { return std::to_string(count); }
  std::string operator()(const Figure& figure) const {
    return figure && std::isfinite(*figure) ? number(*figure) : "";
  }
  std::string operator()(const std::vector<double>& values) const {
    std::string text;
    for (const double value : values) text += (text.empty() ? "" : " ") + number(value);
    return text;
  }
};

struct JsonText {
  std::string operator()(const std::string& text) const { return json_quoted(text); }
  std::string operator()(std::int64_t count) const { return std::to_string(count); }
  std::string operator()(const Figure& figure) const {
    return figure && std::isfinite(*figure) ? number(*figure) : "null";
  }
  std::string operator()(const std::vector<double>& values) const {
    std::string text;
    for (const double value : values) text += (text.empty() ? "" : ", ") + number(value);
    return "[" + text + "]";
  }
};

}  // namespace

std::string quality_csv_header(VariantColumn variant) {
  std::string line;
  for (const Field& field : fields_of({}, variant)) {
    line += (line.empty() ? "" : ",") + std::string(field.name);
  }
  return line + "\n";
}

std::string quality_csv_row(const QualityRecord& record, VariantColumn variant) {
  std::string line;
  for (const Field& field : fields_of(record, variant)) {
    line += std::visit(CsvText{}, field.value) + ",";
  }
  line.back() = '\n';
  return line;
}

std::string quality_json(const QualityRecord& record, VariantColumn variant) {
  std::string text;
  for (const Field& field : fields_of(record, variant)) {
    text += fmt::format("{}\"{}\": {}", text.empty() ? "" : ", ", field.name,
                        std::visit(JsonText{}, field.value));
  }
  return "{" + text + "}";
}

}  // namespace shoal
