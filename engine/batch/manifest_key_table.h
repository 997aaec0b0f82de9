// Reading a mapping by tables of its keys.
#pragma once

#include <span>
#include <string_view>
#include <vector>

#include "batch/manifest_keys.h"
#include "batch/manifest_reader.h"

namespace shoal {

// One key of a mapping that is read into a T.
template <typename T>
struct ManifestKeyRule {
  std::string_view key;
  void (*read)(const ManifestReader& reader, const Field& field, T& target);
  std::vector<std::string_view> (*choices)() = nullptr;
};

// The words of a table of choices, for ManifestKeyRule::choices.
template <const auto& kTable>
[[nodiscard]] std::vector<std::string_view> choice_names() {
  std::vector<std::string_view> names;
  for (const auto& choice : kTable) names.push_back(choice.name);
  return names;
}

// A kind of mapping.
struct MappingKind {
  std::string_view name;  // as manifest_keys() calls it
  std::string_view what;  // as a message calls it: "a panorama"
};

// A table together with what it reads into.
template <typename T>
struct KeyTarget {
  std::span<const ManifestKeyRule<T>> rules;
  T* target;

  [[nodiscard]] bool read(const ManifestReader& reader, const Field& field) const {
    for (const ManifestKeyRule<T>& rule : rules) {
      if (rule.key != field.key) continue;
      rule.read(reader, field, *target);
      return true;
    }
    return false;
  }

  void add_names(std::vector<std::string_view>& names) const {
    for (const ManifestKeyRule<T>& rule : rules) names.push_back(rule.key);
  }
};

template <typename T, typename U>
void assign(std::optional<T> value, U& target) {
  if (value) target = std::move(*value);
}

// The tables; each is next to what reads with it.
[[nodiscard]] std::span<const ManifestKeyRule<LinearKeys>> linear_rules();
[[nodiscard]] std::span<const ManifestKeyRule<EntrySettings>> setting_rules();
[[nodiscard]] std::span<const ManifestKeyRule<EntryText>> entry_rules();

// The three axes of a frame told as a mapping.
struct FrameAxes {
  std::string center;
  std::string right;
  std::string up;
};
[[nodiscard]] std::span<const ManifestKeyRule<FrameAxes>> frame_rules();

// The value of a frame: key, or nothing where it is wrong.
[[nodiscard]] std::optional<Frame> read_frame(const ManifestReader& reader, const Field& field);

// A rotation before it is known how it is told.
struct TurnText {
  std::optional<double> yaw;
  std::optional<double> pitch;
  std::optional<double> roll;
  std::optional<std::vector<double>> axis;
  std::optional<double> angle;
  std::optional<std::vector<double>> quaternion;
};
[[nodiscard]] std::span<const ManifestKeyRule<TurnText>> turn_rules();
[[nodiscard]] std::span<const ManifestKeyRule<WindowKey>> window_rules();
[[nodiscard]] std::span<const ManifestKeyRule<ViewsKey>> views_rules();
[[nodiscard]] std::span<const ManifestKeyRule<ViewsKey>> variant_rules();

[[nodiscard]] std::span<const ManifestKeyRule<AmbientLight>> ambient_rules();
[[nodiscard]] std::span<const ManifestKeyRule<DirectionalLight>> directional_rules();
[[nodiscard]] std::span<const ManifestKeyRule<DiskLight>> disk_rules();
[[nodiscard]] std::span<const ManifestKeyRule<CosineLobe>> cosine_rules();
[[nodiscard]] std::span<const ManifestKeyRule<std::vector<AnalyticLight>>> light_rules();

[[nodiscard]] std::span<const ManifestKeyRule<PixelPolicy>> clamp_rules();
[[nodiscard]] std::span<const ManifestKeyRule<SunSettings>> sun_rules();

// The values of clamp: and sun:, which take the place of what was there.
void read_clamp(const ManifestReader& reader, const Field& field, PixelPolicy& policy);
void read_sun(const ManifestReader& reader, const Field& field, SunSettings& sun);

// The values of rotate:, window: and lights:, or nothing where they are wrong.
[[nodiscard]] std::optional<TurnKey> read_turn(const ManifestReader& reader, const Field& field);
[[nodiscard]] std::optional<WindowKey> read_window(const ManifestReader& reader,
                                                   const Field& field);
[[nodiscard]] std::optional<std::vector<AnalyticLight>> read_lights(const ManifestReader& reader,
                                                                    const Field& field);

// A sun before it is known whether its elevation is told.
struct SkySunText {
  std::optional<double> elevation;
  double azimuth = 0.0;
};
[[nodiscard]] std::span<const ManifestKeyRule<SkySunText>> sky_sun_rules();
[[nodiscard]] std::span<const ManifestKeyRule<SkyKey>> sky_rules();

// A picture, with the key that only one format has.
struct PictureText {
  PictureRequest request;
  std::optional<Field> type;
};
[[nodiscard]] std::span<const ManifestKeyRule<PictureText>> picture_rules();

// The values of sky: and picture:, or nothing where they are wrong.
[[nodiscard]] std::optional<SkyKey> read_sky(const ManifestReader& reader, const Field& field);
[[nodiscard]] std::optional<PictureRequest> read_picture(const ManifestReader& reader,
                                                         const Field& field);

// A map, with the keys that are read once all are known, since they decide over one another.
struct MapText {
  MapRequest request;
  std::optional<Field> kind;
  std::optional<Field> layout;
  std::optional<Field> format;
  std::optional<Field> size;
  std::optional<Field> samples;
  std::optional<Field> faces;
  std::optional<Field> preview;
};
[[nodiscard]] std::span<const ManifestKeyRule<MapText>> map_rules();

// A map of the maps: list, or nothing where it is wrong.
[[nodiscard]] std::optional<MapRequest> read_map(const ManifestReader& reader,
                                                 const YAML::Node& node);

// An export before its profile is loaded.
struct ExportText {
  std::optional<Field> profile;
  std::vector<std::pair<Field, std::string>> options;  // with the words that are chosen
  std::optional<Frame> frame;
  std::string suffix;
};
[[nodiscard]] std::span<const ManifestKeyRule<ExportText>> export_rules();

// An item of the exports: list, or nothing where it is wrong.
[[nodiscard]] std::optional<ExportRequest> read_export(const ManifestReader& reader,
                                                       const YAML::Node& node);

// The words for quantities, in quantities: and as the kind of a map.
inline constexpr Choice<Quantity> kQuantityChoices[] = {
    {"radiance", Quantity::radiance},
    {"irradiance", Quantity::irradiance},
    {"irradiance_over_pi", Quantity::irradiance_over_pi}};

// The words for what becomes of a sky's sun: in entries, and in the store's line of YAML.
inline constexpr Choice<SunDisk> kSunDiskChoices[] = {{"shown", SunDisk::shown},
                                                      {"hidden", SunDisk::hidden}};

// The words for the samples of an EXR file.
inline constexpr Choice<MapSamples> kSampleChoices[] = {{"half", MapSamples::half},
                                                        {"float", MapSamples::single}};

// The words for windows, whose parameters are then the usual ones.
inline constexpr Choice<WindowKey> kWindowWords[] = {
    {"none", {WindowFit::given, {WindowKind::none, {}}}},
    {"hann", {WindowFit::given, {WindowKind::hann, {}}}},
    {"lanczos", {WindowFit::given, {WindowKind::lanczos, {}}}},
    {"gauss", {WindowFit::given, {WindowKind::gauss, {}}}},
    {"laplacian", {WindowFit::given, {WindowKind::laplacian, {}}}},
    {"auto", {WindowFit::automatic, {}}}};

// The words for what a projection depends on besides its file: in entries, and in the line of YAML
// that the store keeps of them.
inline constexpr Choice<PixelPolicy::NonFinite> kNonFiniteChoices[] = {
    {"error", PixelPolicy::NonFinite::error}, {"zero", PixelPolicy::NonFinite::zero}};
inline constexpr Choice<PixelPolicy::Negative> kNegativeChoices[] = {
    {"keep", PixelPolicy::Negative::keep}, {"zero", PixelPolicy::Negative::zero}};
inline constexpr Choice<SunSettings> kNoSunChoices[] = {{"none", {}}};
inline constexpr Choice<SunSettings::Action> kSunActionChoices[] = {
    {"keep", SunSettings::Action::keep},
    {"remove", SunSettings::Action::remove},
    {"replace", SunSettings::Action::replace}};
inline constexpr Choice<RgbeDecode> kRgbeDecodeChoices[] = {{"floor", RgbeDecode::floor},
                                                            {"center", RgbeDecode::center}};
inline constexpr Choice<Encoding> kEncodingChoices[] = {{"srgb", Encoding::srgb},
                                                        {"linear", Encoding::linear}};

// The words for how a picture may be mirrored.
inline constexpr Choice<Mirror> kMirrorChoices[] = {{"none", Mirror::none},
                                                    {"left-right", Mirror::left_right}};

// The words for what a variant keeps of its dominant light.
inline constexpr Choice<DominantPart> kDominantChoices[] = {
    {"keep", DominantPart::keep}, {"remove", DominantPart::remove}, {"only", DominantPart::only}};

// The kinds of mapping.
extern const MappingKind kManifestMapping;
extern const MappingKind kDefaultsMapping;
extern const MappingKind kPanoramaMapping;
extern const MappingKind kVariantMapping;
extern const MappingKind kMapMapping;
extern const MappingKind kExportMapping;
extern const MappingKind kClampMapping;
extern const MappingKind kSunMapping;
extern const MappingKind kFrameMapping;
extern const MappingKind kTurnMapping;
extern const MappingKind kWindowMapping;
extern const MappingKind kViewsMapping;
extern const MappingKind kLightMapping;
extern const MappingKind kAmbientMapping;
extern const MappingKind kDirectionalMapping;
extern const MappingKind kDiskMapping;
extern const MappingKind kCosineMapping;
extern const MappingKind kSkyMapping;
extern const MappingKind kSkySunMapping;
extern const MappingKind kPictureMapping;

// Tells a key that no table holds: in its place elsewhere, or misspelt.
void tell_unknown_key(const ManifestReader& reader, const Field& field, const MappingKind& kind,
                      const std::vector<std::string_view>& known);

// Reads a mapping, each field by the first table that knows its key. False where `node` is none.
template <typename... T>
bool read_mapping(const ManifestReader& reader, const YAML::Node& node, const MappingKind& kind,
                  const KeyTarget<T>&... targets) {
  const auto fields = reader.fields(node, kind.what);
  if (!fields) return false;
  for (const Field& field : *fields) {
    if ((targets.read(reader, field) || ...)) continue;
    std::vector<std::string_view> known;
    (targets.add_names(known), ...);
    tell_unknown_key(reader, field, kind, known);
  }
  return true;
}

}  // namespace shoal
