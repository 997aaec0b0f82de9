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
  std::string_view name;                      // as manifest_keys() calls it
  std::string_view what;                      // as a message calls it: "a panorama"
  std::span<const std::string_view> later{};  // keys that a later version brings
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

// The words for quantities, in quantities: and as the kind of a map.
inline constexpr Choice<Quantity> kQuantityChoices[] = {
    {"radiance", Quantity::radiance},
    {"irradiance", Quantity::irradiance},
    {"irradiance_over_pi", Quantity::irradiance_over_pi}};

// The words for what a projection depends on besides its file: in entries, and in the line of YAML
// that the store keeps of them.
inline constexpr Choice<PixelPolicy::NonFinite> kNonFiniteChoices[] = {
    {"error", PixelPolicy::NonFinite::error}, {"zero", PixelPolicy::NonFinite::zero}};
inline constexpr Choice<PixelPolicy::Negative> kNegativeChoices[] = {
    {"keep", PixelPolicy::Negative::keep}, {"zero", PixelPolicy::Negative::zero}};
inline constexpr Choice<RgbeDecode> kRgbeDecodeChoices[] = {{"floor", RgbeDecode::floor},
                                                            {"center", RgbeDecode::center}};
inline constexpr Choice<Encoding> kEncodingChoices[] = {{"srgb", Encoding::srgb},
                                                        {"linear", Encoding::linear}};

// The kinds of mapping with the keys that later versions bring.
extern const MappingKind kManifestMapping;
extern const MappingKind kDefaultsMapping;
extern const MappingKind kPanoramaMapping;
extern const MappingKind kVariantMapping;
extern const MappingKind kMapMapping;
extern const MappingKind kFrameMapping;

[[nodiscard]] bool is_later_key(const MappingKind& kind, std::string_view key);

// Tells a key that no table holds: not available yet, in its place elsewhere, or misspelt.
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
