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

std::string frame_text(const EntrySettings& settings, const Variant& variant) {
  return "frame " + text_of(frame_of(settings, variant)) + "\n";
}

}  // namespace

std::string parameter_text(const EntrySettings& settings) {
  const ReadOptions& read = settings.read;
  const ProjectionSettings& projection = settings.projection;
  return fmt::format(
      "{{layer: {}, part: {}, rgbe_decode: {}, encoding: {}, degree: {}, quadrature: {}, "
      "nonfinite: {}, negative: {}, clamp: {}, arithmetic: {}}}",
      quoted(read.layer), quoted(read.part), name_in(kRgbeDecodeChoices, read.rgbe_decode),
      name_in(kEncodingChoices, read.encoding), projection.degree, name_of(projection.quadrature),
      name_in(kNonFiniteChoices, projection.pixels.nonfinite),
      name_in(kNegativeChoices, projection.pixels.negative), projection.pixels.clamp,
      name_in(kArithmeticChoices, projection.arithmetic));
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
    return result;
  } catch (const YAML::Exception&) {
    return Error{ErrorCode::malformed, "parameters in the store cannot be read: " + text, "", ""};
  }
}

std::string output_hash(const Manifest& manifest, const PanoramaEntry& entry) {
  if (manifest.maps.empty()) return hash_text("");
  std::string text;
  for (const Variant& variant : manifest.variants) {
    text += counted(variant.name) + " " + colour_text(*entry.settings, variant);
    for (const MapRequest& map : manifest.maps) {
      text += fmt::format("map {} layout {} size {} {} format {} samples {} faces {} stops {}\n",
                          name_of(map.kind), static_cast<int>(map.layout), map.width, map.height,
                          static_cast<int>(map.format), static_cast<int>(map.samples),
                          static_cast<int>(map.faces), map.preview_stops);
      // Equirect maps lie as their panoramas do, whatever the frame.
      if (map.layout == MapLayout::cube) text += frame_text(*entry.settings, variant);
      for (const std::string& file : map_files(manifest, entry, variant, map)) {
        text += counted(file) + "\n";
      }
    }
  }
  return hash_text(text);
}

std::string table_hash(const Manifest& manifest, const EntrySettings& settings) {
  std::string text;
  for (const Variant& variant : manifest.variants) {
    text += counted(variant.name) + " " + colour_text(settings, variant);
    text += frame_text(settings, variant);
  }
  for (const Quantity quantity : manifest.quantities) text += std::string(name_of(quantity)) + "\n";
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
