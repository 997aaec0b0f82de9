#include "sphere/frame.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <glm/matrix.hpp>
#include <optional>
#include <vector>

#include "core/diagnostic.h"
#include "sphere/rotation.h"

namespace shoal {
namespace {

constexpr SignedAxis kPlusX{0, 1}, kMinusX{0, -1}, kPlusY{1, 1}, kMinusY{1, -1}, kPlusZ{2, 1},
    kMinusZ{2, -1};

// s = sin(theta), theta from the top row, phi from the left column to the right.
constexpr Frame kNative{kMinusX, kMinusY, kPlusZ};     // (s cos phi, s sin phi, cos theta)
constexpr Frame kOpenExr{kPlusZ, kMinusX, kPlusY};     // (s sin phi, cos theta, -s cos phi)
constexpr Frame kCmft{kPlusZ, kPlusX, kPlusY};         // (-s sin phi, cos theta, -s cos phi)
constexpr Frame kThree{kPlusX, kPlusZ, kPlusY};        // (-s cos phi, cos theta, -s sin phi)
constexpr Frame kMaterialX{kMinusZ, kPlusX, kMinusY};  // (-s sin phi, -cos theta, s cos phi)

constexpr FrameAlias kAliases[] = {
    {"native", kNative, "shoal, sphere/conventions.h"},
    {"google-sh", kNative, "google/spherical-harmonics"},
    {"libsharp", kNative, "libsharp"},
    {"openexr", kOpenExr, "OpenEXR, ImfEnvmap.cpp, LATLONG"},
    {"usd", kOpenExr, "OpenUSD, DomeLight, latlong"},
    {"mitsuba", kOpenExr, "Mitsuba 3, latlong environment"},
    {"oiio", kOpenExr, "OpenImageIO, latlong environment with y up"},
    {"cmgen", kOpenExr, "Filament, tools/cmgen, which mirrors by default"},
    {"cmgen-no-mirror", kCmft, "Filament, tools/cmgen --no-mirror"},
    {"cmft", kCmft, "cmft, src/cmft/cubemapfilter.cpp"},
    {"babylon", kCmft, "Babylon.js, HighDynamicRange"},
    {"vtk", kThree, "VTK, vtkSphericalHarmonics"},
    {"three", kThree, "three.js"},
    {"gltf", kThree,
     "glTF pull request 1761: a draft appendix, its right inferred from its rotation"},
    {"materialx", kMaterialX, "MaterialX, source/MaterialXRender/Harmonics.cpp; y points down"},
};

std::string quoted(std::string_view text) { return '"' + std::string(text) + '"'; }

std::string without_blanks_lower(std::string_view text) {
  std::string plain;
  for (const unsigned char c : text) {
    if (!std::isspace(c)) plain += static_cast<char>(std::tolower(c));
  }
  return plain;
}

std::optional<SignedAxis> parse_axis(std::string_view text) {
  const std::string plain = without_blanks_lower(text);
  const bool has_sign = plain.size() == 2 && (plain[0] == '+' || plain[0] == '-');
  if (!has_sign && plain.size() != 1) return std::nullopt;
  const char letter = plain.back();
  if (letter < 'x' || letter > 'z') return std::nullopt;
  return SignedAxis{letter - 'x', plain[0] == '-' ? -1 : 1};
}

std::vector<std::string_view> split_at_commas(std::string_view text) {
  std::vector<std::string_view> parts;
  while (true) {
    const std::size_t comma = text.find(',');
    parts.push_back(text.substr(0, comma));
    if (comma == std::string_view::npos) return parts;
    text.remove_prefix(comma + 1);
  }
}

Error unknown_name(std::string_view text, std::string_view plain) {
  std::vector<std::string_view> names;
  for (const FrameAlias& alias : kAliases) names.push_back(alias.name);
  const std::string_view near = closest_match(plain, names);
  std::string known;
  for (const std::string_view name : names) known += std::string(name) + ", ";
  return Error{ErrorCode::usage, "unknown frame " + quoted(text), "",
               near.empty() ? "name one of " + known +
                                  "or say where the picture's centre, right and up point, such as "
                                  "+z,-x,+y"
                            : "did you mean " + quoted(near) + "?"};
}

SignedAxis opposite(const SignedAxis& axis) { return {axis.axis, -axis.sign}; }

}  // namespace

glm::dvec3 direction_of(const SignedAxis& axis) {
  glm::dvec3 direction(0.0);
  direction[axis.axis] = axis.sign;
  return direction;
}

std::span<const FrameAlias> frame_aliases() { return kAliases; }

Result<Frame> parse_frame(std::string_view text) {
  const std::string plain = without_blanks_lower(text);
  const auto alias = std::find_if(std::begin(kAliases), std::end(kAliases),
                                  [&](const FrameAlias& a) { return a.name == plain; });
  if (alias != std::end(kAliases)) return alias->frame;
  const std::vector<std::string_view> parts = split_at_commas(plain);
  if (parts.size() == 1) return unknown_name(text, plain);
  if (parts.size() != 3) {
    return Error{ErrorCode::usage,
                 "a frame has three axes, " + quoted(text) + " has " + std::to_string(parts.size()),
                 "", "say where the picture's centre, right and up point, such as +z,-x,+y"};
  }
  return parse_frame(parts[0], parts[1], parts[2]);
}

Result<Frame> parse_frame(std::string_view center, std::string_view right, std::string_view up) {
  const std::array<std::string_view, 3> texts = {center, right, up};
  std::array<SignedAxis, 3> axes;
  for (int i = 0; i < 3; ++i) {
    const std::optional<SignedAxis> axis = parse_axis(texts[i]);
    if (!axis) {
      return Error{ErrorCode::usage, quoted(texts[i]) + " is not a signed axis", "",
                   "use +x, -x, +y, -y, +z or -z"};
    }
    axes[i] = *axis;
  }
  const Frame frame{axes[0], axes[1], axes[2]};
  if (axes[0].axis == axes[1].axis || axes[1].axis == axes[2].axis ||
      axes[2].axis == axes[0].axis) {
    return Error{ErrorCode::usage, "the frame " + text_of(frame) + " uses an axis twice", "",
                 "centre, right and up lie on three different axes, such as +z,-x,+y"};
  }
  return frame;
}

std::string text_of(const Frame& frame) {
  std::string text;
  for (const SignedAxis& axis : {frame.center, frame.right, frame.up}) {
    if (!text.empty()) text += ',';
    text += axis.sign < 0 ? '-' : '+';
    text += static_cast<char>('x' + axis.axis);
  }
  return text;
}

glm::dmat3 native_to_frame(const Frame& frame) {
  // The native centre is -x, right is -y, up is +z; a column is where an axis goes.
  return {direction_of(opposite(frame.center)), direction_of(opposite(frame.right)),
          direction_of(frame.up)};
}

bool mirrors(const Frame& frame) { return glm::determinant(native_to_frame(frame)) < 0.0; }

Coefficients to_frame(const Coefficients& native, const Frame& frame) {
  return rotate(native, native_to_frame(frame));
}

}  // namespace shoal
