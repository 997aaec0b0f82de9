// The keys of panoramas and of defaults, but for the linear ones.
#include "batch/manifest_key_table.h"

namespace shoal {
namespace {

constexpr Choice<Quadrature> kQuadratures[] = {
    {"texel", Quadrature::texel}, {"midpoint", Quadrature::midpoint}, {"fejer", Quadrature::fejer}};

constexpr auto kLayouts = [] {
  std::array<Choice<Layout>, kLayoutNames.size()> choices{};
  for (std::size_t i = 0; i < choices.size(); ++i) {
    choices[i] = {kLayoutNames[i].name, kLayoutNames[i].layout};
  }
  return choices;
}();

std::vector<std::string> texts_of(const ManifestReader& reader, const Field& field) {
  std::vector<std::string> texts;
  for (LocatedText& located : reader.texts(field)) texts.push_back(std::move(located.text));
  return texts;
}

const ManifestKeyRule<EntrySettings> kSettingRules[] = {
    {"degree",
     [](const ManifestReader& reader, const Field& field, EntrySettings& settings) {
       assign(reader.integer(field, {0, kMaxDegree}), settings.projection.degree);
     }},
    {"quality",
     [](const ManifestReader& reader, const Field& field, EntrySettings& settings) {
       assign(reader.integer(field, {0, kMaxDegree}), settings.projection.quality_degree);
     }},
    {"quadrature",
     [](const ManifestReader& reader, const Field& field, EntrySettings& settings) {
       assign(reader.choice<Quadrature>(field, kQuadratures), settings.projection.quadrature);
     },
     choice_names<kQuadratures>},
    {"layout",
     [](const ManifestReader& reader, const Field& field, EntrySettings& settings) {
       assign(reader.choice<Layout>(field, kLayouts), settings.projection.layout);
     },
     choice_names<kLayouts>},
    {"nonfinite",
     [](const ManifestReader& reader, const Field& field, EntrySettings& settings) {
       assign(reader.choice<PixelPolicy::NonFinite>(field, kNonFiniteChoices),
              settings.projection.pixels.nonfinite);
     },
     choice_names<kNonFiniteChoices>},
    {"negative",
     [](const ManifestReader& reader, const Field& field, EntrySettings& settings) {
       assign(reader.choice<PixelPolicy::Negative>(field, kNegativeChoices),
              settings.projection.pixels.negative);
     },
     choice_names<kNegativeChoices>},
    {"clamp",
     [](const ManifestReader& reader, const Field& field, EntrySettings& settings) {
       read_clamp(reader, field, settings.projection.pixels);
     }},
    {"sun",
     [](const ManifestReader& reader, const Field& field, EntrySettings& settings) {
       read_sun(reader, field, settings.projection.sun);
     },
     choice_names<kNoSunChoices>},
    {"rgbe_decode",
     [](const ManifestReader& reader, const Field& field, EntrySettings& settings) {
       assign(reader.choice<RgbeDecode>(field, kRgbeDecodeChoices), settings.read.rgbe_decode);
     },
     choice_names<kRgbeDecodeChoices>},
    {"encoding",
     [](const ManifestReader& reader, const Field& field, EntrySettings& settings) {
       assign(reader.choice<Encoding>(field, kEncodingChoices), settings.read.encoding);
     },
     choice_names<kEncodingChoices>},
    {"layer", [](const ManifestReader& reader, const Field& field,
                 EntrySettings& settings) { assign(reader.text(field), settings.read.layer); }},
    {"part", [](const ManifestReader& reader, const Field& field,
                EntrySettings& settings) { assign(reader.text(field), settings.read.part); }},
    {"tags", [](const ManifestReader& reader, const Field& field,
                EntrySettings& settings) { settings.tags = texts_of(reader, field); }},
    {"lights",
     [](const ManifestReader& reader, const Field& field, EntrySettings& settings) {
       assign(read_lights(reader, field), settings.lights);
     }},
};

template <std::optional<LocatedText> EntryText::*kMember>
void read_one_text(const ManifestReader& reader, const Field& field, EntryText& entry) {
  std::optional<std::string> text = reader.text(field);
  if (text) entry.*kMember = LocatedText{std::move(*text), reader.loc(field.value)};
}

template <std::vector<LocatedText> EntryText::*kMember>
void read_texts(const ManifestReader& reader, const Field& field, EntryText& entry) {
  entry.*kMember = reader.texts(field);
}

const ManifestKeyRule<EntryText> kEntryRules[] = {
    {"file", read_one_text<&EntryText::file>},
    {"files", read_texts<&EntryText::files>},
    {"name", read_one_text<&EntryText::name>},
    {"exclude", read_texts<&EntryText::exclude>},
    {"sky", [](const ManifestReader& reader, const Field& field,
               EntryText& entry) { entry.settings.sky = read_sky(reader, field); }},
    {"picture", [](const ManifestReader& reader, const Field& field,
                   EntryText& entry) { entry.settings.picture = read_picture(reader, field); }},
};

bool has_key(const YAML::Node& node, std::string_view key) {
  return std::any_of(node.begin(), node.end(), [key](const auto& pair) {
    return pair.first.IsScalar() && pair.first.Scalar() == key;
  });
}

// What is done to the samples of a file. Defaults may have it; light without a file is left alone.
bool check_no_pixel_keys(const ManifestReader& reader, const YAML::Node& node,
                         std::string_view what, EntrySettings& settings) {
  bool is_right = true;
  for (const std::string_view key : {"clamp", "sun"}) {
    if (!has_key(node, key)) continue;
    reader.error(node, fmt::format("{} is for the pixels of a file, not for {}", key, what),
                 "leave it out");
    is_right = false;
  }
  settings.projection.sun = {};
  settings.projection.pixels = {};
  return is_right;
}

// An entry without a file: a sky, or lights alone.
bool check_fileless_keys(const ManifestReader& reader, const YAML::Node& node, EntryText& entry) {
  EntrySettings& settings = entry.settings;
  const bool is_sky = has_key(node, "sky");
  settings.origin = is_sky ? LightOrigin::sky : LightOrigin::lights;
  const std::string_view what = is_sky ? "a sky" : "lights alone";
  if (!entry.name) {
    reader.error(node, fmt::format("an entry of {} needs a name", what), "say name: NAME");
  }
  if (!entry.exclude.empty()) {
    reader.error(node, fmt::format("exclude goes with files, not with {}", what), "leave it out");
  }
  if (!is_sky && node["lights"].IsSequence() && node["lights"].size() == 0) {
    reader.error(node, "this entry has neither a file nor a light",
                 "say file: PATH, or add lights");
  }
  const bool has_light = is_sky ? settings.sky.has_value() : !settings.lights.empty();
  if (!check_no_pixel_keys(reader, node, what, settings)) return false;
  return entry.name && entry.exclude.empty() && has_light;
}

// Whether the keys that name files make sense together; told where they do not.
bool check_file_keys(const ManifestReader& reader, const YAML::Node& node, EntryText& entry) {
  const bool has_file = has_key(node, "file");
  const bool has_files = has_key(node, "files");
  if (has_file && has_files) {
    reader.error(node, "an entry names either file or files", "make it two entries");
    return false;
  }
  if (has_files && entry.name) {
    reader.error(node, "name goes with file, not with files", "files are named by their paths");
    return false;
  }
  if (has_file && !entry.exclude.empty()) {
    reader.error(node, "exclude goes with files, not with file", "leave it out");
    return false;
  }
  for (const std::string_view key : {"sky", "picture"}) {
    if (!(has_file || has_files) || !has_key(node, key)) continue;
    reader.error(node, fmt::format("{} does not go with {}", key, has_file ? "file" : "files"),
                 "it belongs to an entry without a file");
    return false;
  }
  if (has_file || has_files) return true;
  if (has_key(node, "sky") || has_key(node, "lights")) {
    return check_fileless_keys(reader, node, entry);
  }
  reader.error(node, "this entry names no panorama",
               "say file: PATH, files: PATTERN, sky: MAPPING, or lights: LIST");
  return false;
}

}  // namespace

std::span<const ManifestKeyRule<EntrySettings>> setting_rules() { return kSettingRules; }
std::span<const ManifestKeyRule<EntryText>> entry_rules() { return kEntryRules; }

std::optional<EntryText> read_entry(const ManifestReader& reader, const YAML::Node& node,
                                    const EntrySettings& defaults) {
  if (node.IsScalar()) {
    reader.error(node,
                 "a panorama must be a mapping of keys to values, not " + in_quotes(node.Scalar()),
                 "write \"file: PATH\" or \"files: PATTERN\"");
    return std::nullopt;
  }
  EntryText entry;
  entry.settings = defaults;
  entry.loc = reader.loc(node);
  entry.folder = reader.document().folder;
  if (!read_mapping(reader, node, kPanoramaMapping, KeyTarget<EntryText>{kEntryRules, &entry},
                    KeyTarget<EntrySettings>{kSettingRules, &entry.settings},
                    KeyTarget<LinearKeys>{linear_rules(), &entry.settings.linear})) {
    return std::nullopt;
  }
  if (!check_file_keys(reader, node, entry)) return std::nullopt;
  return entry;
}

}  // namespace shoal
