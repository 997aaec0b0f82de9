// The keys of panoramas, of defaults, and those that variants share with them.
#include <limits>

#include "batch/manifest_key_table.h"

namespace shoal {
namespace {

using Limits = std::numeric_limits<double>;
constexpr NumberRule kStops{-100.0, 100.0, "a number of stops from -100 to 100"};
constexpr NumberRule kAboveZero{Limits::denorm_min(), Limits::max(), "a number above 0"};
constexpr NumberRule kNotNegative{0.0, Limits::max(), "a number that is not negative"};
constexpr NumberRule kAnyNumber{Limits::lowest(), Limits::max(), "a number"};
constexpr std::string_view kMatrixForm = "three lists of three numbers, the matrix's rows";

constexpr Choice<Quadrature> kQuadratures[] = {
    {"texel", Quadrature::texel}, {"midpoint", Quadrature::midpoint}, {"fejer", Quadrature::fejer}};

template <typename T, typename U>
void assign(std::optional<T> value, U& target) {
  if (value) target = std::move(*value);
}

std::optional<glm::dmat3> read_matrix(const ManifestReader& reader, const Field& field) {
  const auto rows = reader.items(field, kMatrixForm);
  if (!rows) return std::nullopt;
  if (rows->size() != 3) {
    reader.error(field.value,
                 fmt::format("matrix must be {}, not a list of {}", kMatrixForm, rows->size()));
    return std::nullopt;
  }
  glm::dmat3 matrix{1.0};
  for (int row = 0; row < 3; ++row) {
    const auto numbers =
        reader.numbers({field.key, field.key_node, (*rows)[row]}, 3, kAnyNumber, kMatrixForm);
    if (!numbers) return std::nullopt;
    for (int column = 0; column < 3; ++column) matrix[column][row] = (*numbers)[column];
  }
  return matrix;
}

std::optional<glm::dvec3> read_white(const ManifestReader& reader, const Field& field) {
  const auto rgb = reader.numbers(field, 3, kAboveZero, "a list of three numbers above 0");
  if (!rgb) return std::nullopt;
  return glm::dvec3((*rgb)[0], (*rgb)[1], (*rgb)[2]);
}

template <std::string FrameAxes::*kAxis>
void read_axis(const ManifestReader& reader, const Field& field, FrameAxes& axes) {
  assign(reader.text(field), axes.*kAxis);
}

constexpr ManifestKeyRule<FrameAxes> kFrameRules[] = {{"center", read_axis<&FrameAxes::center>},
                                                      {"right", read_axis<&FrameAxes::right>},
                                                      {"up", read_axis<&FrameAxes::up>}};

Result<Frame> parse_axes(const ManifestReader& reader, const Field& field) {
  FrameAxes axes;
  read_mapping(reader, field.value, kFrameMapping, KeyTarget<FrameAxes>{kFrameRules, &axes});
  if (axes.center.empty() || axes.right.empty() || axes.up.empty()) {
    return Error{ErrorCode::usage, "a frame needs center, right and up", "",
                 "such as {center: +z, right: -x, up: +y}"};
  }
  return parse_frame(axes.center, axes.right, axes.up);
}

std::optional<Frame> read_frame(const ManifestReader& reader, const Field& field) {
  std::optional<std::string> text;
  if (!field.value.IsMap()) {
    text = reader.text(field);
    if (!text) return std::nullopt;
  }
  const Result<Frame> frame = text ? parse_frame(*text) : parse_axes(reader, field);
  if (frame) return *frame;
  reader.error(field.value, frame.error().what, frame.error().hint);
  return std::nullopt;
}

const ManifestKeyRule<LinearKeys> kLinearRules[] = {
    {"exposure",
     [](const ManifestReader& reader, const Field& field, LinearKeys& keys) {
       assign(reader.number(field, kStops), keys.exposure_stops);
     }},
    {"scale", [](const ManifestReader& reader, const Field& field,
                 LinearKeys& keys) { assign(reader.number(field, kAboveZero), keys.scale); }},
    {"matrix", [](const ManifestReader& reader, const Field& field,
                  LinearKeys& keys) { assign(read_matrix(reader, field), keys.matrix); }},
    {"white", [](const ManifestReader& reader, const Field& field,
                 LinearKeys& keys) { assign(read_white(reader, field), keys.white); }},
    {"frame", [](const ManifestReader& reader, const Field& field,
                 LinearKeys& keys) { assign(read_frame(reader, field), keys.frame); }},
};

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
    {"quadrature",
     [](const ManifestReader& reader, const Field& field, EntrySettings& settings) {
       assign(reader.choice<Quadrature>(field, kQuadratures), settings.projection.quadrature);
     },
     choice_names<kQuadratures>},
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
       assign(reader.number(field, kNotNegative), settings.projection.pixels.clamp);
     }},
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
};

bool has_key(const YAML::Node& node, std::string_view key) {
  return std::any_of(node.begin(), node.end(), [key](const auto& pair) {
    return pair.first.IsScalar() && pair.first.Scalar() == key;
  });
}

// Whether the keys that name files make sense together; told where they do not.
bool check_file_keys(const ManifestReader& reader, const YAML::Node& node, const EntryText& entry) {
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
  if (has_file || has_files) return true;
  const bool is_later = std::any_of(node.begin(), node.end(), [](const auto& pair) {
    return pair.first.IsScalar() && is_later_key(kPanoramaMapping, pair.first.Scalar());
  });
  if (!is_later) {
    reader.error(node, "this entry names no panorama", "say file: PATH or files: PATTERN");
  }
  return false;
}

}  // namespace

std::span<const ManifestKeyRule<LinearKeys>> linear_rules() { return kLinearRules; }
std::span<const ManifestKeyRule<EntrySettings>> setting_rules() { return kSettingRules; }
std::span<const ManifestKeyRule<EntryText>> entry_rules() { return kEntryRules; }
std::span<const ManifestKeyRule<FrameAxes>> frame_rules() { return kFrameRules; }

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
                    KeyTarget<LinearKeys>{kLinearRules, &entry.settings.linear})) {
    return std::nullopt;
  }
  if (!check_file_keys(reader, node, entry)) return std::nullopt;
  return entry;
}

}  // namespace shoal
