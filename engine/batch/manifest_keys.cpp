#include "batch/manifest_keys.h"

#include <utility>
#include <variant>

#include "batch/manifest_key_table.h"

namespace shoal {
namespace {

using AnyTable = std::variant<TableFormat, FigureTable>;
constexpr Choice<AnyTable> kTables[] = {{"csv", TableFormat::csv},
                                        {"json", TableFormat::json},
                                        {"npy", TableFormat::npy},
                                        {"quality", FigureTable::quality},
                                        {"lights", FigureTable::lights}};

void read_defaults(const ManifestReader& reader, const Field& field, ManifestText& text) {
  read_mapping(reader, field.value, kDefaultsMapping,
               KeyTarget<EntrySettings>{setting_rules(), &text.defaults},
               KeyTarget<LinearKeys>{linear_rules(), &text.defaults.linear});
}

void read_panoramas(const ManifestReader& reader, const Field& field, ManifestText& text) {
  const auto items = reader.items(field, "a list of entries");
  if (!items) return;
  for (const YAML::Node& item : *items) text.panoramas.push_back({text.document, item});
}

// Letters that make sense in a file's name and in a table: so no slash, no dot, no blank.
bool check_variant_name(const ManifestReader& reader, const Field& field) {
  if (ManifestVariables::is_name(field.key)) return true;
  reader.error(field.key_node, fmt::format("{} cannot be a variant's name", in_quotes(field.key)),
               "use letters, digits, - and _");
  return false;
}

void read_variants(const ManifestReader& reader, const Field& field, ManifestText& text) {
  const auto fields = reader.fields(field.value, "variants");
  if (!fields) return;
  for (const Field& one : *fields) {
    VariantText variant{{one.key, {}, reader.loc(one.key_node)}, {}};
    read_mapping(reader, one.value, kVariantMapping,
                 KeyTarget<LinearKeys>{linear_rules(), &variant.variant.linear},
                 KeyTarget<ViewsKey>{variant_rules(), &variant.views});
    if (!check_variant_name(reader, one)) continue;
    const auto known =
        std::find_if(text.variants.begin(), text.variants.end(),
                     [&one](const VariantText& other) { return other.variant.name == one.key; });
    if (known == text.variants.end())
      text.variants.push_back(std::move(variant));
    else
      *known = std::move(variant);
  }
}

template <typename E>
void replace_choices(const ManifestReader& reader, const Field& field,
                     std::span<const Choice<E>> table, std::vector<E>& target) {
  const auto values = reader.choices<E>(field, table);
  if (!values) return;
  if (values->empty() && field.value.size() == 0) {
    reader.error(field.value, fmt::format("{} must name at least one", field.key),
                 "leave the key out for its default");
  }
  target = *values;
}

void read_tables(const ManifestReader& reader, const Field& field, ManifestText& text) {
  std::vector<AnyTable> tables;
  replace_choices<AnyTable>(reader, field, kTables, tables);
  text.tables.clear();
  text.figure_tables.clear();
  for (const AnyTable& table : tables) {
    if (const auto* format = std::get_if<TableFormat>(&table)) text.tables.push_back(*format);
    if (const auto* figures = std::get_if<FigureTable>(&table)) {
      text.figure_tables.push_back(*figures);
    }
  }
}

void read_maps(const ManifestReader& reader, const Field& field, ManifestText& text) {
  const auto items = reader.items(field, "a list of maps, such as [{kind: irradiance}]");
  if (!items) return;
  text.maps.clear();
  for (const YAML::Node& item : *items) {
    if (std::optional<MapRequest> map = read_map(reader, item))
      text.maps.push_back(std::move(*map));
  }
}

void read_exports(const ManifestReader& reader, const Field& field, ManifestText& text) {
  std::vector<YAML::Node> nodes{field.value};
  if (!field.value.IsScalar()) {
    const auto items = reader.items(field, "a list of profiles, such as [three, unity]");
    if (!items) return;
    nodes = *items;
  }
  text.exports.clear();
  for (const YAML::Node& node : nodes) {
    if (std::optional<ExportRequest> request = read_export(reader, node))
      text.exports.push_back(std::move(*request));
  }
}

void read_nothing(const ManifestReader&, const Field&, ManifestText&) {}

const ManifestKeyRule<ManifestText> kManifestRules[] = {
    {"shoal", read_nothing},  // whoever loads the documents reads these three first
    {"vars", read_nothing},
    {"include", read_nothing},
    {"output",
     [](const ManifestReader& reader, const Field& field, ManifestText& text) {
       std::optional<std::string> path = reader.text(field);
       if (!path) return;
       text.output = LocatedText{std::move(*path), reader.loc(field.value)};
       text.output_folder = reader.document().folder;
     }},
    {"defaults", read_defaults},
    {"panoramas", read_panoramas},
    {"variants", read_variants},
    {"quantities",
     [](const ManifestReader& reader, const Field& field, ManifestText& text) {
       replace_choices<Quantity>(reader, field, kQuantityChoices, text.quantities);
     },
     choice_names<kQuantityChoices>},
    {"tables",
     [](const ManifestReader& reader, const Field& field, ManifestText& text) {
       read_tables(reader, field, text);
       text.tables_loc = reader.loc(field.value);
     },
     choice_names<kTables>},
    {"maps", read_maps},
    {"exports", read_exports},
};

template <typename T>
void add_keys(const MappingKind& kind, std::span<const ManifestKeyRule<T>> rules,
              std::vector<ManifestKey>& keys) {
  for (const ManifestKeyRule<T>& rule : rules) {
    keys.push_back({kind.name, rule.key, {}});
    if (rule.choices) keys.back().choices = rule.choices();
  }
}

// The mappings that know a key, for those who put it into another one: "a panorama or defaults".
std::string mappings_of_key(std::string_view key) {
  std::string mappings;
  for (const ManifestKey& known : manifest_keys()) {
    if (known.key != key) continue;
    for (const MappingKind* kind :
         {&kManifestMapping, &kDefaultsMapping, &kPanoramaMapping,    &kVariantMapping,
          &kMapMapping,      &kExportMapping,   &kClampMapping,       &kSunMapping,
          &kFrameMapping,    &kTurnMapping,     &kWindowMapping,      &kViewsMapping,
          &kLightMapping,    &kAmbientMapping,  &kDirectionalMapping, &kDiskMapping,
          &kCosineMapping,   &kSkyMapping,      &kSkySunMapping,      &kPictureMapping}) {
      if (kind->name != known.mapping) continue;
      mappings += fmt::format("{}{}", mappings.empty() ? "" : " or ", kind->what);
    }
  }
  return mappings;
}

}  // namespace

const MappingKind kManifestMapping{"manifest", "the manifest's top level"};
const MappingKind kDefaultsMapping{"defaults", "defaults"};
const MappingKind kPanoramaMapping{"panorama", "a panorama"};
const MappingKind kVariantMapping{"variant", "a variant"};
const MappingKind kMapMapping{"map", "a map"};
const MappingKind kExportMapping{"export", "an export"};
const MappingKind kClampMapping{"clamp", "a clamp"};
const MappingKind kSunMapping{"sun", "a sun"};
const MappingKind kFrameMapping{"frame", "a frame"};
const MappingKind kTurnMapping{"rotate", "a rotation"};
const MappingKind kWindowMapping{"window", "a window"};
const MappingKind kViewsMapping{"views", "views"};
const MappingKind kLightMapping{"light", "a light"};
const MappingKind kAmbientMapping{"ambient", "an ambient light"};
const MappingKind kDirectionalMapping{"directional", "a directional light"};
const MappingKind kDiskMapping{"disk", "a disk"};
const MappingKind kCosineMapping{"cosine", "a cosine lobe"};
const MappingKind kSkyMapping{"sky", "a sky"};
const MappingKind kSkySunMapping{"sky_sun", "a sky's sun"};
const MappingKind kPictureMapping{"picture", "a picture"};

void tell_unknown_key(const ManifestReader& reader, const Field& field, const MappingKind& kind,
                      const std::vector<std::string_view>& known) {
  std::string hint = did_you_mean(field.key, known);
  const std::string elsewhere = mappings_of_key(field.key);
  const std::size_t colon = field.key.find(':');
  if (!elsewhere.empty()) {
    hint = fmt::format("it belongs to {}", elsewhere);
  } else if (colon != std::string::npos && field.value.IsNull()) {
    hint = "put a blank after the colon";
  } else if (field.key == "<<") {
    hint = "put what entries share under defaults:";
  } else if (hint.empty()) {
    hint = fmt::format("known here: {}", fmt::join(known, ", "));
  }
  reader.error(field.key_node, fmt::format("unknown key {} in {}", in_quotes(field.key), kind.what),
               std::move(hint));
}

void read_top_level(const ManifestReader& reader,
                    const std::shared_ptr<const ManifestDocument>& document, ManifestText& text) {
  text.document = document;
  read_mapping(reader, document->root, kManifestMapping,
               KeyTarget<ManifestText>{kManifestRules, &text});
}

std::vector<ManifestKey> manifest_keys() {
  std::vector<ManifestKey> keys;
  add_keys<ManifestText>(kManifestMapping, kManifestRules, keys);
  add_keys(kPanoramaMapping, entry_rules(), keys);
  add_keys(kPanoramaMapping, setting_rules(), keys);
  add_keys(kPanoramaMapping, linear_rules(), keys);
  add_keys(kDefaultsMapping, setting_rules(), keys);
  add_keys(kDefaultsMapping, linear_rules(), keys);
  add_keys(kVariantMapping, linear_rules(), keys);
  add_keys(kVariantMapping, variant_rules(), keys);
  add_keys(kMapMapping, map_rules(), keys);
  add_keys(kExportMapping, export_rules(), keys);
  add_keys(kClampMapping, clamp_rules(), keys);
  add_keys(kSunMapping, sun_rules(), keys);
  add_keys(kFrameMapping, frame_rules(), keys);
  add_keys(kTurnMapping, turn_rules(), keys);
  add_keys(kWindowMapping, window_rules(), keys);
  add_keys(kViewsMapping, views_rules(), keys);
  add_keys(kLightMapping, light_rules(), keys);
  add_keys(kAmbientMapping, ambient_rules(), keys);
  add_keys(kDirectionalMapping, directional_rules(), keys);
  add_keys(kDiskMapping, disk_rules(), keys);
  add_keys(kCosineMapping, cosine_rules(), keys);
  add_keys(kSkyMapping, sky_rules(), keys);
  add_keys(kSkySunMapping, sky_sun_rules(), keys);
  add_keys(kPictureMapping, picture_rules(), keys);
  return keys;
}

}  // namespace shoal
