// The linear keys, which panoramas, defaults and variants share.
#include <limits>

#include "batch/manifest_key_table.h"

namespace shoal {
namespace {

using Limits = std::numeric_limits<double>;
constexpr NumberRule kStops{-100.0, 100.0, "a number of stops from -100 to 100"};
constexpr NumberRule kAboveZero{Limits::denorm_min(), Limits::max(), "a number above 0"};
constexpr NumberRule kAnyNumber{Limits::lowest(), Limits::max(), "a number"};
constexpr std::string_view kMatrixForm = "three lists of three numbers, the matrix's rows";

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

}  // namespace

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

namespace {

const ManifestKeyRule<LinearKeys> kLinearRules[] = {
    {"mirror",
     [](const ManifestReader& reader, const Field& field, LinearKeys& keys) {
       assign(reader.choice<Mirror>(field, kMirrorChoices), keys.mirror);
     },
     choice_names<kMirrorChoices>},
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
    {"rotate", [](const ManifestReader& reader, const Field& field,
                  LinearKeys& keys) { assign(read_turn(reader, field), keys.turn); }},
    {"window",
     [](const ManifestReader& reader, const Field& field, LinearKeys& keys) {
       assign(read_window(reader, field), keys.window);
     },
     choice_names<kWindowWords>},
    {"dominant",
     [](const ManifestReader& reader, const Field& field, LinearKeys& keys) {
       assign(reader.choice<DominantPart>(field, kDominantChoices), keys.dominant);
     },
     choice_names<kDominantChoices>},
};

}  // namespace

std::span<const ManifestKeyRule<LinearKeys>> linear_rules() { return kLinearRules; }
std::span<const ManifestKeyRule<FrameAxes>> frame_rules() { return kFrameRules; }

}  // namespace shoal
