#include "batch/fingerprint.h"

#include <fmt/format.h>
#include <yaml-cpp/yaml.h>

#include <algorithm>

#include "batch/manifest_key_table.h"
#include "core/content_hash.h"

namespace shoal {
namespace {

constexpr Choice<Arithmetic> kArithmeticChoices[] = {{"kernels", Arithmetic::kernels},
                                                     {"reference", Arithmetic::reference}};

template <typename E, std::size_t kCount>
std::string_view name_in(const Choice<E> (&choices)[kCount], E value) {
  return std::ranges::find(choices, value, &Choice<E>::value)->name;
}

// Throws as yaml-cpp does where the name is none of them.
template <typename E, std::size_t kCount>
E value_in(const Choice<E> (&choices)[kCount], const std::string& name) {
  for (const auto& choice : choices) {
    if (name == choice.name) return choice.value;
  }
  throw YAML::RepresentationException(YAML::Mark::null_mark(), name);
}

// As a string of YAML. Its emitter takes 30 us for a whole line, so it is asked only for what may
// need escapes.
std::string quoted(const std::string& text) {
  if (text.empty()) return "\"\"";
  YAML::Emitter out;
  out << YAML::DoubleQuoted << text;
  return out.c_str();
}

// Texts are quoted by their length, so that no two lists of parameters read the same.
std::string counted(std::string_view text) { return fmt::format("{}:{}", text.size(), text); }

std::string colour_text(const EntrySettings& settings, const Variant& variant) {
  const ColourOperations colour = colour_of(settings, variant);
  std::string text =
      fmt::format("exposure {} scale {} matrix", colour.exposure_stops, colour.scale);
  for (int row = 0; row < 3; ++row) {
    for (int column = 0; column < 3; ++column) {
      text += fmt::format(" {}", colour.matrix[column][row]);
    }
  }
  if (colour.white) {
    text += fmt::format(" white {} {} {}", colour.white->r, colour.white->g, colour.white->b);
  }
  return text + "\n";
}

std::string vector_text(const glm::dvec3& v) { return fmt::format(" {} {} {}", v.x, v.y, v.z); }

// A text a kind of light.
struct LightText {
  std::string operator()(const AmbientLight& light) const {
    return "ambient" + vector_text(light.radiance);
  }
  std::string operator()(const DirectionalLight& light) const {
    return "directional" + vector_text(light.direction) + vector_text(light.irradiance);
  }
  std::string operator()(const DiskLight& light) const {
    return fmt::format("disk {}", light.angular_radius) + vector_text(light.direction) +
           vector_text(light.radiance);
  }
  std::string operator()(const CosineLobe& light) const {
    return "cosine" + vector_text(light.direction) + vector_text(light.radiance);
  }
};

std::string lights_text(const EntrySettings& settings) {
  std::string text;
  for (const AnalyticLight& light : native_lights(settings)) {
    text += std::visit(LightText{}, light) + "; ";
  }
  return text;
}

// Rotation and window of a variant, and the entry's lights.
std::string light_text(const EntrySettings& settings, const Variant& variant) {
  std::string text = "lights " + lights_text(settings) + "turn";
  // A manifest with a rotation that is none is refused before anything is asked for here.
  const auto turn = turn_of(settings, variant);
  for (int column = 0; turn && column < 3; ++column) text += vector_text((*turn)[column]);
  const WindowKey window = window_of(settings, variant);
  text += window.fit == WindowFit::automatic
              ? " window auto"
              : fmt::format(" window {}", name_of(window.window.kind));
  if (window.window.parameter) text += fmt::format(" {}", *window.window.parameter);
  text += mirror_of(settings, variant) == glm::dmat3(1.0) ? "" : " mirrored";
  text += fmt::format(" dominant {}", name_in(kDominantChoices, dominant_of(settings, variant)));
  return text + "\n";
}

// Nothing for the default, which stores from before layouts hold without a word.
std::string layout_text(Layout layout) {
  return layout == Layout::equirect ? "" : fmt::format(", layout: {}", name_of(layout));
}

// Nothing where it changes nothing.
std::string quality_text(const ProjectionSettings& projection) {
  return projection.highest_degree() == projection.degree
             ? ""
             : fmt::format(", quality: {}", projection.quality_degree);
}

// Likewise.
std::string bright_text(const ProjectionSettings& projection) {
  std::string text;
  if (projection.pixels.clamp_percentile > 0.0) {
    text += fmt::format(", clamp_percentile: {}", projection.pixels.clamp_percentile);
  }
  const SunSettings& sun = projection.sun;
  if (sun.asked()) {
    text += fmt::format(", sun: {{top: {}, above: {}, action: {}}}", sun.top, sun.above,
                        name_in(kSunActionChoices, sun.action));
  }
  return text;
}

// Throws as yaml-cpp does where it is not what bright_text() wrote.
void parse_bright(const YAML::Node& node, ProjectionSettings& projection) {
  if (node["clamp_percentile"]) {
    projection.pixels.clamp_percentile = node["clamp_percentile"].as<double>();
  }
  const YAML::Node sun = node["sun"];
  if (!sun) return;
  projection.sun = {sun["top"].as<double>(), sun["above"].as<double>(),
                    value_in(kSunActionChoices, sun["action"].as<std::string>())};
}

// Nothing where there is none.
std::string sky_text(const EntrySettings& settings) {
  if (!settings.sky) return "";
  const SkyKey& sky = *settings.sky;
  const glm::dvec3& ground = sky.model.ground_albedo;
  return fmt::format(
      "sky: {{turbidity: {}, elevation: {}, azimuth: {}, ground: [{}, {}, {}], disk: {}, size: "
      "[{}, "
      "{}]}}, ",
      sky.model.turbidity, sky.model.sun_elevation, sky.model.sun_azimuth, ground.r, ground.g,
      ground.b, name_in(kSunDiskChoices, sky.disk), sky.width, sky.height);
}

// Throws as yaml-cpp does where it is not what sky_text() wrote.
SkyKey parse_sky(const YAML::Node& node) {
  SkyKey sky;
  sky.model.turbidity = node["turbidity"].as<double>();
  sky.model.sun_elevation = node["elevation"].as<double>();
  sky.model.sun_azimuth = node["azimuth"].as<double>();
  for (int c = 0; c < 3; ++c) sky.model.ground_albedo[c] = node["ground"][c].as<double>();
  sky.disk = value_in(kSunDiskChoices, node["disk"].as<std::string>());
  sky.width = node["size"][0].as<int>();
  sky.height = node["size"][1].as<int>();
  return sky;
}

std::string picture_text(const PanoramaEntry& entry) {
  const EntrySettings& settings = *entry.settings;
  if (!settings.picture) return "";
  const PictureFile file = picture_file(entry);
  return fmt::format("picture {} size {} {} samples {} lights {}\n", counted(file.name), file.width,
                     file.height, static_cast<int>(settings.picture->samples),
                     lights_text(settings));
}

std::string frame_text(const EntrySettings& settings, const Variant& variant) {
  return "frame " + text_of(frame_of(settings, variant)) + "\n";
}

}  // namespace

std::string parameter_text(const EntrySettings& settings) {
  if (settings.origin == LightOrigin::lights) {
    return fmt::format("{{lights: {}, degree: {}{}}}", quoted(lights_text(settings)),
                       settings.projection.degree, quality_text(settings.projection));
  }
  const ReadOptions& read = settings.read;
  const ProjectionSettings& projection = settings.projection;
  return fmt::format(
      "{{{}layer: {}, part: {}, rgbe_decode: {}, encoding: {}, degree: {}, quadrature: {}, "
      "nonfinite: {}, negative: {}, clamp: {}, arithmetic: {}{}{}{}}}",
      sky_text(settings), quoted(read.layer), quoted(read.part),
      name_in(kRgbeDecodeChoices, read.rgbe_decode), name_in(kEncodingChoices, read.encoding),
      projection.degree, name_of(projection.quadrature),
      name_in(kNonFiniteChoices, projection.pixels.nonfinite),
      name_in(kNegativeChoices, projection.pixels.negative), projection.pixels.clamp,
      name_in(kArithmeticChoices, projection.arithmetic), layout_text(projection.layout),
      quality_text(projection), bright_text(projection));
}

Result<ProjectionParameters> parse_parameters(const std::string& text) {
  try {
    const YAML::Node node = YAML::Load(text);
    const auto value = [&node](const char* key) { return node[key].as<std::string>(); };
    ProjectionParameters result;
    result.read.layer = value("layer");
    result.read.part = value("part");
    result.read.rgbe_decode = value_in(kRgbeDecodeChoices, value("rgbe_decode"));
    result.read.encoding = value_in(kEncodingChoices, value("encoding"));
    result.projection.degree = node["degree"].as<int>();
    SHOAL_ASSIGN_OR_RETURN(quadrature, parse_quadrature(value("quadrature")));
    result.projection.quadrature = quadrature;
    result.projection.pixels.nonfinite = value_in(kNonFiniteChoices, value("nonfinite"));
    result.projection.pixels.negative = value_in(kNegativeChoices, value("negative"));
    result.projection.pixels.clamp = node["clamp"].as<double>();
    result.projection.arithmetic = value_in(kArithmeticChoices, value("arithmetic"));
    if (node["quality"]) result.projection.quality_degree = node["quality"].as<int>();
    if (node["layout"]) {
      SHOAL_ASSIGN_OR_RETURN(layout, parse_layout(value("layout")));
      result.projection.layout = layout;
    }
    parse_bright(node, result.projection);
    if (node["sky"]) result.sky = parse_sky(node["sky"]);
    return result;
  } catch (const YAML::Exception&) {
    return Error{ErrorCode::malformed, "parameters in the store cannot be read: " + text, "", ""};
  }
}

std::string output_hash(const Manifest& manifest, const PanoramaEntry& entry) {
  const std::string picture = picture_text(entry);
  const bool quality = wants_quality(manifest, *entry.settings);
  if (manifest.maps.empty() && manifest.exports.empty() && !quality) return hash_text(picture);
  std::string text = picture;
  for (const Variant& variant : manifest.variants) {
    text += counted(variant.name) + " " + colour_text(*entry.settings, variant);
    text += light_text(*entry.settings, variant);
    if (quality) text += "quality\n";
    for (const MapRequest& map : manifest.maps) {
      text += fmt::format("map {} layout {} size {} {} format {} samples {} faces {} stops {}\n",
                          name_of(map.kind), static_cast<int>(map.layout), map.width, map.height,
                          static_cast<int>(map.format), static_cast<int>(map.samples),
                          static_cast<int>(map.faces), map.preview_stops);
      // All others lie as their panoramas do, whatever the frame.
      if (has_faces_of_frame(map)) text += frame_text(*entry.settings, variant);
      for (const std::string& file : map_files(manifest, entry, variant, map)) {
        text += counted(file) + "\n";
      }
    }
    for (const ExportRequest& request : manifest.exports) {
      text += fmt::format("export {} {}\n", request.fingerprint,
                          counted(export_file(manifest, entry, variant, request)));
    }
  }
  return hash_text(text);
}

std::string table_hash(const Manifest& manifest, const EntrySettings& settings) {
  std::string text;
  for (const Variant& variant : manifest.variants) {
    text += counted(variant.name) + " " + colour_text(settings, variant);
    text += light_text(settings, variant);
    text += frame_text(settings, variant);
  }
  for (const Quantity quantity : manifest.quantities) text += std::string(name_of(quantity)) + "\n";
  // The table of lights is of no variant.
  const Variant plain;
  text += colour_text(settings, plain) + light_text(settings, plain) + frame_text(settings, plain);
  return hash_text(text);
}

const std::string& SettingsText::of(const PanoramaEntry& entry) {
  if (entry.settings != settings_) {
    settings_ = entry.settings;
    text_ = make_(*settings_);
  }
  return text_;
}

}  // namespace shoal
