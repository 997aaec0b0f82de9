#include "batch/fingerprint.h"

#include <fmt/format.h>
#include <yaml-cpp/yaml.h>

#include <algorithm>
#include <array>

#include "core/content_hash.h"

namespace shoal {
namespace {

template <typename E>
struct Named {
  const char* name;
  E value;
};

constexpr std::array kRgbeDecodes = {Named{"floor", RgbeDecode::floor},
                                     Named{"center", RgbeDecode::center}};
constexpr std::array kEncodings = {Named{"srgb", Encoding::srgb},
                                   Named{"linear", Encoding::linear}};
constexpr std::array kNonFinites = {Named{"error", PixelPolicy::NonFinite::error},
                                    Named{"zero", PixelPolicy::NonFinite::zero}};
constexpr std::array kNegatives = {Named{"keep", PixelPolicy::Negative::keep},
                                   Named{"zero", PixelPolicy::Negative::zero}};
constexpr std::array kArithmetics = {Named{"kernels", Arithmetic::kernels},
                                     Named{"reference", Arithmetic::reference}};

template <typename E, std::size_t kCount>
std::string name_in(const std::array<Named<E>, kCount>& names, E value) {
  return std::ranges::find(names, value, &Named<E>::value)->name;
}

// Throws as yaml-cpp does where the name is none of them.
template <typename E, std::size_t kCount>
E value_in(const std::array<Named<E>, kCount>& names, const std::string& name) {
  for (const auto& named : names) {
    if (name == named.name) return named.value;
  }
  throw YAML::RepresentationException(YAML::Mark::null_mark(), name);
}

// Texts are quoted by their length, so that no two lists of parameters read the same.
std::string counted(std::string_view text) { return fmt::format("{}:{}", text.size(), text); }

std::string colour_text(const PanoramaEntry& entry, const Variant& variant) {
  const ColourOperations colour = colour_of(entry, variant);
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

std::string frame_text(const PanoramaEntry& entry, const Variant& variant) {
  return "frame " + text_of(frame_of(entry, variant)) + "\n";
}

}  // namespace

std::string parameter_text(const PanoramaEntry& entry) {
  const ReadOptions& read = entry.read;
  const ProjectionSettings& projection = entry.projection;
  YAML::Emitter out;
  out << YAML::Flow << YAML::BeginMap;
  out << YAML::Key << "layer" << YAML::Value << YAML::DoubleQuoted << read.layer;
  out << YAML::Key << "part" << YAML::Value << YAML::DoubleQuoted << read.part;
  const auto add = [&out](const char* key, const std::string& value) {
    out << YAML::Key << key << YAML::Value << value;
  };
  add("rgbe_decode", name_in(kRgbeDecodes, read.rgbe_decode));
  add("encoding", name_in(kEncodings, read.encoding));
  add("degree", std::to_string(projection.degree));
  add("quadrature", std::string(name_of(projection.quadrature)));
  add("nonfinite", name_in(kNonFinites, projection.pixels.nonfinite));
  add("negative", name_in(kNegatives, projection.pixels.negative));
  add("clamp", fmt::format("{}", projection.pixels.clamp));
  add("arithmetic", name_in(kArithmetics, projection.arithmetic));
  out << YAML::EndMap;
  return out.c_str();
}

Result<ProjectionParameters> parse_parameters(const std::string& text) {
  try {
    const YAML::Node node = YAML::Load(text);
    const auto value = [&node](const char* key) { return node[key].as<std::string>(); };
    ProjectionParameters result;
    result.read.layer = value("layer");
    result.read.part = value("part");
    result.read.rgbe_decode = value_in(kRgbeDecodes, value("rgbe_decode"));
    result.read.encoding = value_in(kEncodings, value("encoding"));
    result.projection.degree = node["degree"].as<int>();
    SHOAL_ASSIGN_OR_RETURN(quadrature, parse_quadrature(value("quadrature")));
    result.projection.quadrature = quadrature;
    result.projection.pixels.nonfinite = value_in(kNonFinites, value("nonfinite"));
    result.projection.pixels.negative = value_in(kNegatives, value("negative"));
    result.projection.pixels.clamp = node["clamp"].as<double>();
    result.projection.arithmetic = value_in(kArithmetics, value("arithmetic"));
    return result;
  } catch (const YAML::Exception&) {
    return Error{ErrorCode::malformed, "parameters in the store cannot be read: " + text, "", ""};
  }
}

std::string output_hash(const Manifest& manifest, const PanoramaEntry& entry) {
  if (manifest.maps.empty()) return hash_text("");
  std::string text;
  for (const Variant& variant : manifest.variants) {
    text += counted(variant.name) + " " + colour_text(entry, variant);
    for (const MapRequest& map : manifest.maps) {
      text += fmt::format("map {} layout {} size {} {} format {} samples {} faces {} stops {}\n",
                          name_of(map.kind), static_cast<int>(map.layout), map.width, map.height,
                          static_cast<int>(map.format), static_cast<int>(map.samples),
                          static_cast<int>(map.faces), map.preview_stops);
      // Equirect maps lie as their panoramas do, whatever the frame.
      if (map.layout == MapLayout::cube) text += frame_text(entry, variant);
      for (const std::string& file : map_files(manifest, entry, variant, map)) {
        text += counted(file) + "\n";
      }
    }
  }
  return hash_text(text);
}

std::string table_hash(const Manifest& manifest, const PanoramaEntry& entry) {
  std::string text = counted(entry.name) + "\n";
  for (const Variant& variant : manifest.variants) {
    text += counted(variant.name) + " " + colour_text(entry, variant) + frame_text(entry, variant);
  }
  for (const Quantity quantity : manifest.quantities) text += std::string(name_of(quantity)) + "\n";
  return hash_text(text);
}

}  // namespace shoal
