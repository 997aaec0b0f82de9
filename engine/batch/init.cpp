#include "batch/init.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <iterator>
#include <map>
#include <system_error>
#include <vector>

#include "batch/glob.h"

namespace shoal {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view kHighRange[] = {"exr", "hdr", "pfm", "pic", "rgbe", "tif", "tiff"};
constexpr std::string_view kLowRange[] = {"bmp", "jpeg", "jpg", "png", "tga", "webp"};

// Files by extension, as it is spelt; and whether one lies in a folder below.
struct Pictures {
  std::map<std::string, int> counts;
  bool in_folders = false;
};

std::string lower(std::string text) {
  std::transform(text.begin(), text.end(), text.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return text;
}

template <std::size_t kCount>
Pictures select(const std::vector<std::string>& paths,
                const std::string_view (&extensions)[kCount]) {
  Pictures pictures;
  for (const std::string& path : paths) {
    const std::string extension = fs::path(path).extension().string();
    if (extension.empty()) continue;
    const auto* const known =
        std::find(std::begin(extensions), std::end(extensions), lower(extension.substr(1)));
    if (known == std::end(extensions)) continue;
    ++pictures.counts[extension.substr(1)];
    pictures.in_folders = pictures.in_folders || path.find('/') != std::string::npos;
  }
  return pictures;
}

std::string pattern_of(const Pictures& pictures) {
  std::string extensions;
  for (const auto& [extension, count] : pictures.counts) {
    extensions += (extensions.empty() ? "" : ",") + extension;
  }
  if (pictures.counts.size() > 1) extensions = "{" + extensions + "}";
  return (pictures.in_folders ? "**/*." : "*.") + extensions;
}

std::string counts_of(const Pictures& pictures) {
  std::string text;
  for (const auto& [extension, count] : pictures.counts) {
    text += fmt::format("{}{} .{}", text.empty() ? "" : ", ", count, extension);
  }
  return text;
}

constexpr std::string_view kTemplate =
    R"(# A manifest of shoal: which panoramas to project, and what to write of them.
#   shoal check shoal.yaml    shows what would be done
#   shoal run shoal.yaml      does it; a second time only what has changed
# manifests/README.md in shoal's sources tells every key.
shoal: 1

# Where everything goes, relative to this file: coefficients.csv, maps/, shoal.db.
output: out

# For every panorama; an entry below may say otherwise.
defaults:
  degree: 2            # (2+1)^2 = 9 coefficients a channel; up to 64
  quadrature: texel    # or midpoint, fejer
  nonfinite: error     # or zero: pixels that are infinite or not a number count as black

panoramas:
  # Found here when this manifest was made: {counts}.
  - files: "{pattern}"
    # exclude: "*_thumb*"
    # tags: [outdoor]
    # exposure: 1.5    # stops, applied to the coefficients
  # A panorama by itself, with a name and settings of its own:
  # - {{file: studio.exr, name: key-light, exposure: -1}}

# Each panorama is decoded once for all of these.
# variants:
#   plain: {{}}
#   dark: {{exposure: -2}}

quantities: [radiance, irradiance]    # also irradiance_over_pi
tables: [csv]                         # also json, npy

maps:
  - {{kind: irradiance, size: [400, 200], format: exr}}
  # - {{kind: radiance, layout: cube, size: 32}}
  # - {{kind: irradiance, format: png, exposure: 0}}    # a preview
)";

}  // namespace

Result<std::string> initial_manifest(const fs::path& folder) {
  std::error_code error;
  if (!fs::is_directory(folder, error)) {
    return Error{ErrorCode::not_found, error ? error.message() : "is not a folder", folder.string(),
                 "name the folder that holds the panoramas"};
  }
  SHOAL_ASSIGN_OR_RETURN(everything, Glob::parse("**/*"));
  const GlobMatches matches = everything.expand(folder);
  if (matches.paths.empty() && !matches.unreadable.empty()) {
    return Error{ErrorCode::unreadable, matches.unreadable[0].reason, matches.unreadable[0].path,
                 ""};
  }
  Pictures pictures = select(matches.paths, kHighRange);
  if (pictures.counts.empty()) pictures = select(matches.paths, kLowRange);
  if (pictures.counts.empty()) {
    return Error{ErrorCode::not_found, "no panorama lies here or in a folder below",
                 folder.string(), "shoal looks for .exr, .hdr and the like"};
  }
  return fmt::format(kTemplate, fmt::arg("counts", counts_of(pictures)),
                     fmt::arg("pattern", pattern_of(pictures)));
}

}  // namespace shoal
