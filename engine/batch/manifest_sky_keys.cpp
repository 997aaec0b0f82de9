// The keys of skies and of painted pictures.
#include <array>
#include <optional>

#include "batch/manifest_key_table.h"

namespace shoal {
namespace {

constexpr NumberRule kTurbidity{kMinTurbidity, kMaxTurbidity, "a number from 2 to 10"};
constexpr NumberRule kElevation{0.0, 90.0, "a number of degrees of arc from 0 to 90"};
constexpr NumberRule kAzimuth{-360.0, 360.0, "a number of degrees of arc from -360 to 360"};
constexpr NumberRule kAlbedo{0.0, 1.0, "a number from 0 to 1"};
constexpr NumberRule kSide{1.0, 16384.0, "a whole number from 1 to 16384"};

constexpr Choice<MapFileType> kFormats[] = {{"exr", MapFileType::exr}, {"hdr", MapFileType::hdr}};

// Width and height.
std::optional<std::array<int, 2>> read_picture_size(const ManifestReader& reader,
                                                    const Field& field) {
  const auto size = reader.numbers(field, 2, kSide, "a list of two: width and height");
  if (!size) return std::nullopt;
  for (const double side : *size) {
    if (side == static_cast<int>(side)) continue;
    reader.error(field.value, fmt::format("size must be whole numbers, not {}", side));
    return std::nullopt;
  }
  return std::array{static_cast<int>((*size)[0]), static_cast<int>((*size)[1])};
}

template <typename T>
void read_size(const ManifestReader& reader, const Field& field, T& target) {
  const auto size = read_picture_size(reader, field);
  if (!size) return;
  target.width = (*size)[0];
  target.height = (*size)[1];
}

const ManifestKeyRule<SkySunText> kSkySunRules[] = {
    {"elevation", [](const ManifestReader& reader, const Field& field,
                     SkySunText& sun) { sun.elevation = reader.number(field, kElevation); }},
    {"azimuth", [](const ManifestReader& reader, const Field& field,
                   SkySunText& sun) { assign(reader.number(field, kAzimuth), sun.azimuth); }},
};

void read_sun(const ManifestReader& reader, const Field& field, SkyKey& sky) {
  SkySunText sun;
  if (!read_mapping(reader, field.value, kSkySunMapping, KeyTarget<SkySunText>{kSkySunRules, &sun}))
    return;
  assign(sun.elevation, sky.model.sun_elevation);
  sky.model.sun_azimuth = sun.azimuth;
  const bool is_told = field.value.IsMap() && field.value["elevation"];
  if (!is_told) reader.error(field.value, "a sun needs elevation", "sun: {elevation: 45}");
}

void read_ground(const ManifestReader& reader, const Field& field, SkyKey& sky) {
  if (field.value.IsScalar()) {
    if (const auto grey = reader.number(field, kAlbedo))
      sky.model.ground_albedo = glm::dvec3(*grey);
    return;
  }
  const auto rgb = reader.numbers(field, 3, kAlbedo, "a number or a list of three");
  if (rgb) sky.model.ground_albedo = {(*rgb)[0], (*rgb)[1], (*rgb)[2]};
}

const ManifestKeyRule<SkyKey> kSkyRules[] = {
    {"turbidity",
     [](const ManifestReader& reader, const Field& field, SkyKey& sky) {
       assign(reader.number(field, kTurbidity), sky.model.turbidity);
     }},
    {"sun", read_sun},
    {"ground", read_ground},
    {"size", read_size<SkyKey>},
    {"disk",
     [](const ManifestReader& reader, const Field& field, SkyKey& sky) {
       assign(reader.choice<SunDisk>(field, kSunDiskChoices), sky.disk);
     },
     choice_names<kSunDiskChoices>},
};

const ManifestKeyRule<PictureText> kPictureRules[] = {
    {"size", [](const ManifestReader& reader, const Field& field,
                PictureText& picture) { read_size(reader, field, picture.request); }},
    {"format",
     [](const ManifestReader& reader, const Field& field, PictureText& picture) {
       assign(reader.choice<MapFileType>(field, kFormats), picture.request.format);
     },
     choice_names<kFormats>},
    {"type",
     [](const ManifestReader& reader, const Field& field, PictureText& picture) {
       assign(reader.choice<MapSamples>(field, kSampleChoices), picture.request.samples);
       picture.type = field;
     },
     choice_names<kSampleChoices>},
};

}  // namespace

std::span<const ManifestKeyRule<SkySunText>> sky_sun_rules() { return kSkySunRules; }
std::span<const ManifestKeyRule<SkyKey>> sky_rules() { return kSkyRules; }
std::span<const ManifestKeyRule<PictureText>> picture_rules() { return kPictureRules; }

std::optional<SkyKey> read_sky(const ManifestReader& reader, const Field& field) {
  SkyKey sky;
  if (!read_mapping(reader, field.value, kSkyMapping, KeyTarget<SkyKey>{kSkyRules, &sky})) {
    return std::nullopt;
  }
  if (!field.value.IsMap() || !field.value["sun"]) {
    reader.error(field.value, "a sky needs its sun", "sun: {elevation: 45}");
    return std::nullopt;
  }
  return sky;
}

std::optional<PictureRequest> read_picture(const ManifestReader& reader, const Field& field) {
  PictureText picture;
  if (!read_mapping(reader, field.value, kPictureMapping,
                    KeyTarget<PictureText>{kPictureRules, &picture})) {
    return std::nullopt;
  }
  if (picture.type && picture.request.format != MapFileType::exr) {
    reader.error(picture.type->key_node, "type is for format: exr only", "leave it out");
  }
  return picture.request;
}

}  // namespace shoal
