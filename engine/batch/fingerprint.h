// Hashes of what results depend on, by which the store knows whether they still hold.
//
// Whoever adds a parameter that changes results adds it here; whoever changes what the same
// parameters compute raises kAlgorithmVersion.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <utility>

#include "batch/manifest.h"
#include "core/result.h"

namespace shoal {

// The version of the computation: pixels to coefficients, and coefficients to files.
inline constexpr int kAlgorithmVersion = 3;

// What the projection of a panorama's pixels depends on besides its file.
struct ProjectionParameters {
  ReadOptions read;
  ProjectionSettings projection;
  std::optional<SkyKey> sky;  // that the pixels are painted of, where there is no file
};

// The same as a line of YAML with the manifest's own keys, for the store; its hash tells whether
// two are the same. Band height, threads and SIMD target are not in it: they change no bit.
[[nodiscard]] std::string parameter_text(const EntrySettings& settings);

// Reads back that of a panorama with pixels: of a file, or of a sky. Error: malformed.
Result<ProjectionParameters> parse_parameters(const std::string& text);

// Of what a panorama's own files depend on besides its projection.
[[nodiscard]] std::string output_hash(const Manifest& manifest, const PanoramaEntry& entry);

// Of what a panorama's rows in the tables depend on besides its name and its projection: all
// variants and quantities.
[[nodiscard]] std::string table_hash(const Manifest& manifest, const EntrySettings& settings);

// One of the above for one entry after the other. It is made anew only where the settings are
// others than those of the entry before, which in a library of 100,000 files is hardly ever.
class SettingsText {
 public:
  using Make = std::function<std::string(const EntrySettings&)>;
  explicit SettingsText(Make make) : make_(std::move(make)) {}

  // Lives until the next call.
  [[nodiscard]] const std::string& of(const PanoramaEntry& entry);

 private:
  Make make_;
  std::shared_ptr<const EntrySettings> settings_;
  std::string text_;
};

}  // namespace shoal
