// The keys of maps.
#include "batch/manifest_key_table.h"

namespace shoal {
namespace {

constexpr Choice<MapLayout> kLayouts[] = {
    {"equirect", MapLayout::equirect},
    {"cube", MapLayout::cube},
    {"cube-vertical-cross", MapLayout::cube_vertical_cross},
    {"cube-horizontal-cross", MapLayout::cube_horizontal_cross},
    {"cube-vertical-strip", MapLayout::cube_vertical_strip},
    {"cube-horizontal-strip", MapLayout::cube_horizontal_strip},
    {"angular", MapLayout::angular},
    {"mirror-ball", MapLayout::mirror_ball},
    {"octahedral", MapLayout::octahedral},
    {"octahedral-equal-area", MapLayout::octahedral_equal_area},
    {"cube-openexr", MapLayout::cube_openexr}};
constexpr Choice<MapFileType> kFormats[] = {
    {"exr", MapFileType::exr}, {"hdr", MapFileType::hdr}, {"png", MapFileType::png}};
constexpr Choice<CubeFaces> kFaces[] = {{"strip", CubeFaces::strip}, {"files", CubeFaces::files}};

constexpr NumberRule kStops{-100.0, 100.0, "a number of stops from -100 to 100"};
constexpr NumberRule kSide{1.0, 16384.0, "a whole number from 1 to 16384"};
constexpr IntegerRule kEdge{1, 4096};
constexpr int kDefaultEdge = 32;

template <std::optional<Field> MapText::*kMember>
void keep(const ManifestReader&, const Field& field, MapText& map) {
  map.*kMember = field;
}

const ManifestKeyRule<MapText> kMapRules[] = {
    {"kind", keep<&MapText::kind>, choice_names<kQuantityChoices>},
    {"layout", keep<&MapText::layout>, choice_names<kLayouts>},
    {"size", keep<&MapText::size>},
    {"format", keep<&MapText::format>, choice_names<kFormats>},
    {"type", keep<&MapText::samples>, choice_names<kSampleChoices>},
    {"faces", keep<&MapText::faces>, choice_names<kFaces>},
    {"exposure", keep<&MapText::preview>},
    {"suffix",
     [](const ManifestReader& reader, const Field& field, MapText& map) {
       const std::optional<std::string> suffix = reader.text(field);
       if (!suffix) return;
       if (ManifestVariables::is_name(*suffix)) {
         map.request.suffix = *suffix;
       } else {
         reader.error(field.value,
                      fmt::format("{} cannot be part of a file's name here", in_quotes(*suffix)),
                      "use letters, digits, - and _");
       }
     }},
};

void read_size(const ManifestReader& reader, const MapText& map, MapRequest& request) {
  if (request.layout != MapLayout::equirect) {
    const int edge =
        map.size ? reader.integer(*map.size, kEdge).value_or(kDefaultEdge) : kDefaultEdge;
    request.width = request.height = edge;
    return;
  }
  if (!map.size) return;
  const auto size = reader.numbers(*map.size, 2, kSide, "a list of two: width and height");
  if (!size) return;
  for (const double side : *size) {
    if (side == static_cast<int>(side)) continue;
    return reader.error(map.size->value, fmt::format("size must be whole numbers, not {}", side));
  }
  request.width = static_cast<int>((*size)[0]);
  request.height = static_cast<int>((*size)[1]);
}

// The choice of a key that may be absent; nothing where it is wrong.
template <typename E, std::size_t kCount>
std::optional<E> choice_or(const ManifestReader& reader, const std::optional<Field>& field,
                           const Choice<E> (&table)[kCount], E absent) {
  return field ? reader.choice<E>(*field, table) : absent;
}

// A key that only one layout or format has.
bool belongs(const ManifestReader& reader, const std::optional<Field>& field, bool has_it,
             std::string_view whose) {
  if (field && !has_it) {
    reader.error(field->key_node, fmt::format("{} is for {} only", field->key, whose),
                 "leave it out");
  }
  return field && has_it;
}

}  // namespace

std::span<const ManifestKeyRule<MapText>> map_rules() { return kMapRules; }

std::optional<MapRequest> read_map(const ManifestReader& reader, const YAML::Node& node) {
  MapText map;
  if (!read_mapping(reader, node, kMapMapping, KeyTarget<MapText>{kMapRules, &map})) {
    return std::nullopt;
  }
  MapRequest request = map.request;
  request.loc = reader.loc(node);
  if (!map.kind) {
    reader.error(node, "a map needs its kind", "kind: irradiance, radiance or irradiance_over_pi");
    return std::nullopt;
  }
  const auto kind = reader.choice<Quantity>(*map.kind, kQuantityChoices);
  const auto layout = choice_or(reader, map.layout, kLayouts, MapLayout::equirect);
  const auto format = choice_or(reader, map.format, kFormats, MapFileType::exr);
  if (!kind || !layout || !format) return std::nullopt;
  request.kind = *kind;
  request.layout = *layout;
  request.format = *format;
  read_size(reader, map, request);
  if (request.layout == MapLayout::cube_openexr && request.format != MapFileType::exr) {
    reader.error(map.format->value, "layout: cube-openexr is for format: exr only",
                 "its faces are told by EXR's envmap attribute; take cube-vertical-strip");
  }
  if (belongs(reader, map.samples, request.format == MapFileType::exr, "format: exr")) {
    request.samples =
        reader.choice<MapSamples>(*map.samples, kSampleChoices).value_or(MapSamples::half);
  }
  if (belongs(reader, map.faces, request.layout == MapLayout::cube, "layout: cube")) {
    request.faces = reader.choice<CubeFaces>(*map.faces, kFaces).value_or(CubeFaces::strip);
  }
  if (belongs(reader, map.preview, request.format == MapFileType::png, "format: png")) {
    request.preview_stops = reader.number(*map.preview, kStops).value_or(0.0);
  }
  return request;
}

}  // namespace shoal
