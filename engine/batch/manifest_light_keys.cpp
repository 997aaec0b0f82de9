// The keys of lights in closed form.
#include <glm/trigonometric.hpp>
#include <limits>
#include <utility>

#include "batch/manifest_key_table.h"

namespace shoal {
namespace {

using Limits = std::numeric_limits<double>;
constexpr NumberRule kAnyNumber{Limits::lowest(), Limits::max(), "a number"};
constexpr NumberRule kRadius{Limits::denorm_min(), 180.0,
                             "a number of degrees of arc above 0, at most 180"};

// One number for a grey light, or three.
std::optional<glm::dvec3> read_colour(const ManifestReader& reader, const Field& field) {
  if (field.value.IsScalar()) {
    const auto grey = reader.number(field, kAnyNumber);
    return grey ? std::optional(glm::dvec3(*grey)) : std::nullopt;
  }
  const auto rgb = reader.numbers(field, 3, kAnyNumber, "a number or a list of three");
  return rgb ? std::optional(glm::dvec3((*rgb)[0], (*rgb)[1], (*rgb)[2])) : std::nullopt;
}

template <typename Light, glm::dvec3 Light::*kColour>
void read_colour_key(const ManifestReader& reader, const Field& field, Light& light) {
  assign(read_colour(reader, field), light.*kColour);
}

template <typename Light>
void read_direction(const ManifestReader& reader, const Field& field, Light& light) {
  const auto xyz = reader.numbers(field, 3, kAnyNumber, "a list of three numbers");
  if (!xyz) return;
  const glm::dvec3 direction((*xyz)[0], (*xyz)[1], (*xyz)[2]);
  if (direction != glm::dvec3(0.0)) {
    light.direction = direction;
  } else {
    reader.error(field.value, "this direction is zero", "such as direction: [0, 0, 1]");
  }
}

void read_radius(const ManifestReader& reader, const Field& field, DiskLight& light) {
  // What is wrong has been told; it is not to be found wrong once more.
  light.angular_radius = glm::radians(reader.number(field, kRadius).value_or(kRadius.maximum));
}

constexpr ManifestKeyRule<AmbientLight> kAmbientRules[] = {
    {"radiance", read_colour_key<AmbientLight, &AmbientLight::radiance>}};
constexpr ManifestKeyRule<DirectionalLight> kDirectionalRules[] = {
    {"direction", read_direction<DirectionalLight>},
    {"irradiance", read_colour_key<DirectionalLight, &DirectionalLight::irradiance>}};
constexpr ManifestKeyRule<DiskLight> kDiskRules[] = {
    {"direction", read_direction<DiskLight>},
    {"radius", read_radius},
    {"radiance", read_colour_key<DiskLight, &DiskLight::radiance>}};
constexpr ManifestKeyRule<CosineLobe> kCosineRules[] = {
    {"direction", read_direction<CosineLobe>},
    {"radiance", read_colour_key<CosineLobe, &CosineLobe::radiance>}};

// The kind of a light with its own keys, every one of which is needed.
template <typename Light>
void read_kind(const ManifestReader& reader, const Field& field, const MappingKind& kind,
               std::span<const ManifestKeyRule<Light>> rules, std::vector<AnalyticLight>& lights) {
  Light light;
  if (!read_mapping(reader, field.value, kind, KeyTarget<Light>{rules, &light})) return;
  for (const auto& rule : rules) {
    if (field.value.IsMap() && field.value[std::string(rule.key)]) continue;
    return reader.error(field.value, fmt::format("{} needs {}", kind.what, rule.key));
  }
  lights.push_back(light);
}

using Lights = std::vector<AnalyticLight>;

void read_disk(const ManifestReader& reader, const Field& field, Lights& lights) {
  read_kind<DiskLight>(reader, field, kDiskMapping, kDiskRules, lights);
}

const ManifestKeyRule<Lights> kLightRules[] = {
    {"ambient",
     [](const ManifestReader& reader, const Field& field, Lights& lights) {
       read_kind<AmbientLight>(reader, field, kAmbientMapping, kAmbientRules, lights);
     }},
    {"directional",
     [](const ManifestReader& reader, const Field& field, Lights& lights) {
       read_kind<DirectionalLight>(reader, field, kDirectionalMapping, kDirectionalRules, lights);
     }},
    {"disk", read_disk},
    {"cap", read_disk},
    {"cosine", [](const ManifestReader& reader, const Field& field, Lights& lights) {
       read_kind<CosineLobe>(reader, field, kCosineMapping, kCosineRules, lights);
     }}};

}  // namespace

std::span<const ManifestKeyRule<AmbientLight>> ambient_rules() { return kAmbientRules; }
std::span<const ManifestKeyRule<DirectionalLight>> directional_rules() { return kDirectionalRules; }
std::span<const ManifestKeyRule<DiskLight>> disk_rules() { return kDiskRules; }
std::span<const ManifestKeyRule<CosineLobe>> cosine_rules() { return kCosineRules; }
std::span<const ManifestKeyRule<std::vector<AnalyticLight>>> light_rules() { return kLightRules; }

std::optional<std::vector<AnalyticLight>> read_lights(const ManifestReader& reader,
                                                      const Field& field) {
  const auto items = reader.items(field, "a list of lights, such as [{ambient: {radiance: 1}}]");
  if (!items) return std::nullopt;
  std::vector<AnalyticLight> lights;
  for (const YAML::Node& item : *items) {
    if (item.IsMap() && item.size() != 1) {
      reader.error(item, "a light is one kind with its keys, each light an item of the list",
                   "such as - {disk: {direction: [0, 0, 1], radius: 10, radiance: 5}}");
      continue;
    }
    read_mapping(reader, item, kLightMapping, KeyTarget<Lights>{kLightRules, &lights});
  }
  return lights;
}

}  // namespace shoal
