#include "library/painted_pixels.h"

#include <fmt/format.h>

#include <fstream>
#include <numbers>
#include <regex>
#include <sstream>

#include "library/exr_pixels.h"
#include "library/program.h"
#include "library/temporary_folder.h"

namespace shoal::viz {
namespace {

namespace fs = std::filesystem;

// Of "disk 0.1 1 0 0 5 5 5": the kind, a disk's angle, all but the ambient light's direction, and
// the colour. Empty where it is something else.
std::string light_keys(const std::string& light) {
  std::istringstream words(light);
  std::string kind;
  words >> kind;
  double radius = 0.0;
  if (kind == "disk") words >> radius;
  const auto triple = [&words] {
    std::string x, y, z;
    words >> x >> y >> z;
    return fmt::format("[{}, {}, {}]", x, y, z);
  };
  std::string keys;
  if (kind == "disk") keys = fmt::format("radius: {}, ", radius * 180.0 / std::numbers::pi);
  if (kind != "ambient") keys += "direction: " + triple() + ", ";
  keys += (kind == "directional" ? "irradiance: " : "radiance: ") + triple();
  return words ? fmt::format("{}: {{{}}}", kind, keys) : std::string();
}

std::string lights_keys(const std::string& text) {
  std::istringstream lights(text);
  std::string keys;
  for (std::string light; std::getline(lights, light, ';');) {
    const std::string one = light_keys(light);
    if (!one.empty()) keys += fmt::format("{}{{{}}}", keys.empty() ? "" : ", ", one);
  }
  return keys.empty() ? keys : "lights: [" + keys + "]";
}

Error cannot_paint(const std::string& why) { return {ErrorCode::unreadable, why, "", ""}; }

std::string manifest_of(std::span<const std::string> recipes, int width) {
  std::string text = "shoal: 1\noutput: out\ndefaults: {degree: 0}\npanoramas:\n";
  for (std::size_t i = 0; i < recipes.size(); ++i) {
    text += fmt::format("  - {{name: \"{}\", {}, picture: {{size: [{}, {}]}}}}\n", i, recipes[i],
                        width, width / 2);
  }
  return text;
}

// Runs the manifest in the folder.
Status run_manifest(const fs::path& folder, const std::string& manifest) {
  SHOAL_ASSIGN_OR_RETURN(shoal, find_shoal());
  const fs::path file = folder / "paint.yaml";
  std::ofstream(file, std::ios::binary) << manifest;
  SHOAL_ASSIGN_OR_RETURN(finished, run_program(shoal, {"run", file.string()}));
  if (finished.exit_status == 0) return {};
  return cannot_paint("`shoal run` cannot paint it: " +
                      finished.err.substr(0, finished.err.find('\n')));
}

}  // namespace

std::string recipe_of(const std::string& parameters) {
  static const std::regex sky(R"(\{sky: \{(turbidity: [^,]+), (elevation: [^,]+, azimuth: [^,]+), )"
                              R"((ground: \[[^\]]*\], disk: \w+), size: \[[^\]]*\]\}, .*)");
  static const std::regex lights(R"re(\{lights: "([^"]*)", .*)re");
  std::smatch found;
  if (std::regex_match(parameters, found, sky)) {
    // The picture has a size of its own; this one is that of a projection that nobody asks for.
    return fmt::format("sky: {{{}, sun: {{{}}}, {}, size: [64, 32]}}", found.str(1), found.str(2),
                       found.str(3));
  }
  return std::regex_match(parameters, found, lights) ? lights_keys(found.str(1)) : std::string();
}

std::vector<Result<Pixels>> paint(std::span<const std::string> recipes, int width) {
  auto folder = TemporaryFolder::make();
  Status ready = folder ? Status() : Status(folder.error());
  if (ready) ready = run_manifest(folder->path(), manifest_of(recipes, width));
  std::vector<Result<Pixels>> pixels;
  for (std::size_t i = 0; i < recipes.size(); ++i) {
    const fs::path picture = fmt::format("out/maps/{}.picture.exr", i);
    pixels.push_back(ready ? read_exr(folder->path() / picture) : ready.error());
  }
  return pixels;
}

}  // namespace shoal::viz
