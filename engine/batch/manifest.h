// A manifest, read and resolved: what to project, and what to write of it. Every key is told in
// manifests/README.md.
#pragma once

#include <filesystem>
#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "core/diagnostic.h"
#include "image/panorama_source.h"
#include "output/coefficient_table.h"
#include "sphere/frame.h"
#include "sphere/irradiance.h"
#include "sphere/linear_operations.h"
#include "transform/projector.h"

namespace shoal {

// What is linear, so that it waits for the coefficients: the keys of an entry and of a variant.
struct LinearKeys {
  std::optional<double> exposure_stops;
  std::optional<double> scale;
  std::optional<glm::dmat3> matrix;
  std::optional<glm::dvec3> white;
  std::optional<Frame> frame;
};

// Keys of an entry that defaults: may hold, too.
struct EntrySettings {
  ReadOptions read;
  ProjectionSettings projection;
  std::vector<std::string> tags;
  LinearKeys linear;
};

// Where a manifest names a panorama.
struct EntryOrigin {
  std::string pattern;  // that found the file, with its variables replaced; empty for `file:`
  SourceLoc loc;        // of the entry, or of the pattern
};

// One file. A pattern may find a hundred thousand: what is the same for all of them is shared, and
// never null.
struct PanoramaEntry {
  std::string name;  // unique, safe as a path below the output folder
  std::string file;  // a path, absolute or relative to the working directory; as text, since a
                     // std::filesystem::path takes five times the memory
  std::shared_ptr<const EntrySettings> settings = std::make_shared<EntrySettings>();
  std::shared_ptr<const EntryOrigin> origin = std::make_shared<EntryOrigin>();
};

struct Variant {
  std::string name;
  LinearKeys linear;  // each key that is given replaces the entry's
  SourceLoc loc;
};

// What a panorama's colours go through in a variant, and the frame it is told in.
[[nodiscard]] ColourOperations colour_of(const EntrySettings& settings, const Variant& variant);
[[nodiscard]] Frame frame_of(const EntrySettings& settings, const Variant& variant);

enum class MapLayout { equirect, cube };
enum class MapFileType { exr, hdr, png };
enum class MapSamples { half, single };  // EXR only
enum class CubeFaces { strip, files };   // six faces side by side, or a file each

struct MapRequest {
  Quantity kind = Quantity::irradiance;
  MapLayout layout = MapLayout::equirect;
  int width = 400;  // cube: of one face, as is height
  int height = 200;
  MapFileType format = MapFileType::exr;
  MapSamples samples = MapSamples::half;
  CubeFaces faces = CubeFaces::strip;
  double preview_stops = 0.0;  // exposure of a PNG
  std::string suffix;          // tells maps of one kind and layout apart
  SourceLoc loc;
};

struct Manifest {
  std::filesystem::path path;
  std::filesystem::path output;
  std::vector<PanoramaEntry> entries;  // in the order of the tables
  std::vector<Variant> variants;       // at least one; {"plain"} where the manifest names none
  std::vector<Quantity> quantities;    // at least one, none twice
  std::vector<TableFormat> tables;     // likewise
  std::vector<MapRequest> maps;
};

// The faces of a cube in the order of a strip, as their files' names tell them: +x -x +y -y +z -z.
inline constexpr std::string_view kCubeFaceNames[] = {"px", "nx", "py", "ny", "pz", "nz"};

// The files of one map below the output folder: one, or six in the order of kCubeFaceNames.
//   maps/NAME[.VARIANT].KIND[.cube][.SUFFIX][.FACE].EXT
// with the variant only where the manifest has several.
[[nodiscard]] std::vector<std::string> map_files(const Manifest& manifest,
                                                 const PanoramaEntry& entry, const Variant& variant,
                                                 const MapRequest& map);

struct LoadOptions {
  std::vector<std::pair<std::string, std::string>>
      sets;  // --set NAME=VALUE; the last of a name wins
};

struct ManifestResult {
  std::optional<Manifest> manifest;     // none where there is an error
  std::vector<Diagnostic> diagnostics;  // errors and warnings by position, included files after
  std::string messages;                 // all of them laid out, "" where there are none
  int error_count = 0;
};

// Reads a manifest and all that it includes, expands its globs, and tells everything that is wrong
// at once. No panorama is opened.
[[nodiscard]] ManifestResult load_manifest(const std::filesystem::path& path,
                                           const LoadOptions& options = {});

}  // namespace shoal
