// A manifest, read and resolved: what to project, and what to write of it. Every key is told in
// manifests/README.md.
#pragma once

#include <filesystem>
#include <glm/gtc/quaternion.hpp>
#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include "core/diagnostic.h"
#include "image/panorama_source.h"
#include "output/coefficient_table.h"
#include "output/profile.h"
#include "sphere/analytic_lights.h"
#include "sphere/degree_window.h"
#include "sphere/frame.h"
#include "sphere/irradiance.h"
#include "sphere/linear_operations.h"
#include "sphere/preetham_sky.h"
#include "sphere/turns.h"
#include "transform/projector.h"

namespace shoal {

// A rotation about an axis, both in the coordinates of the frame; degrees of arc.
struct AxisTurn {
  glm::dvec3 axis{0.0, 0.0, 1.0};
  double angle = 0.0;
};

// A rotation as a manifest tells it: yaw, pitch and roll of the picture, about an axis, or by a
// quaternion.
using TurnKey = std::variant<PictureTurn, AxisTurn, glm::dquat>;

enum class WindowFit {
  given,      // the window that the manifest tells
  automatic,  // fitted to each panorama (sphere/automatic_window.h)
};

struct WindowKey {
  WindowFit fit = WindowFit::given;
  DegreeWindow window;  // where it is given

  friend bool operator==(const WindowKey&, const WindowKey&) = default;
};

// What is kept of a light's dominant directional light and the rest (sphere/dominant_light.h).
enum class DominantPart {
  keep,    // both
  remove,  // the rest
  only,    // the directional light
};

// Whether the picture is the mirror image of its scene, as a photograph of a mirror ball is.
enum class Mirror { none, left_right };

// What is linear, so that it waits for the coefficients: the keys of an entry and of a variant.
struct LinearKeys {
  std::optional<Mirror> mirror;
  std::optional<double> exposure_stops;
  std::optional<double> scale;
  std::optional<glm::dmat3> matrix;
  std::optional<glm::dvec3> white;
  std::optional<Frame> frame;
  std::optional<TurnKey> turn;
  std::optional<WindowKey> window;
  std::optional<DominantPart> dominant;
};

// Where a panorama's projection comes from.
enum class LightOrigin {
  file,    // the pixels of its file
  lights,  // its lights alone, in closed form
  sky,     // the painted pixels of its sky
};

enum class MapFileType { exr, hdr, png };
enum class MapSamples { half, single };  // EXR only

enum class SunDisk {
  shown,   // the sun is part of the sky, in closed form
  hidden,  // its light falls on the ground only
};

// A sky as a manifest tells it, with the size of the picture that it is projected from.
struct SkyKey {
  PreethamSky model;
  SunDisk disk = SunDisk::shown;
  int width = 1024;
  int height = 512;

  friend bool operator==(const SkyKey&, const SkyKey&) = default;
};

// A picture of a sky, or of lights alone, as it is before anything linear is applied.
struct PictureRequest {
  int width = 0;  // 0: the sky's size, or 1024 x 512
  int height = 0;
  MapFileType format = MapFileType::exr;
  MapSamples samples = MapSamples::single;  // a sun is 20 times what half can hold
};

// Keys of an entry that defaults: may hold, too.
struct EntrySettings {
  LightOrigin origin = LightOrigin::file;
  ReadOptions read;
  ProjectionSettings projection;
  std::vector<std::string> tags;
  std::vector<AnalyticLight> lights;  // directions in the frame of `linear`, the native one if none
  LinearKeys linear;
  // Of one entry only.
  std::optional<SkyKey> sky;
  std::optional<PictureRequest> picture;
};

// Where a manifest names a panorama.
struct EntryOrigin {
  std::string pattern;  // that found the file, with its variables replaced; empty for `file:`
  SourceLoc loc;        // of the entry, or of the pattern
};

// One panorama: a file, a sky, or lights alone. A pattern may find a hundred thousand: what is the
// same for all of them is shared, and never null.
struct PanoramaEntry {
  std::string name;  // unique, safe as a path below the output folder
  std::string file;  // a path, absolute or relative to the working directory, empty where there is
                     // none; as text, since a std::filesystem::path takes five times the memory
  std::shared_ptr<const EntrySettings> settings = std::make_shared<EntrySettings>();
  std::shared_ptr<const EntryOrigin> origin = std::make_shared<EntryOrigin>();
};

// Which rotations the views of a variant are spread over.
enum class ViewsOver {
  yaw,  // about the vertical, evenly
  all,  // all rotations, evenly
};

// A variant that stands for several, NAME-1, NAME-2 ..., each in another rotation.
struct ViewsKey {
  int count = 0;  // 0: a variant like any other
  ViewsOver over = ViewsOver::yaw;
};

struct Variant {
  std::string name;
  LinearKeys linear;  // each key that is given replaces the entry's
  SourceLoc loc;
  std::optional<glm::dmat3> view{};  // one of several: native frame; applied after `rotate`
};

// What a panorama's colours go through in a variant, and the frame it is told in.
[[nodiscard]] ColourOperations colour_of(const EntrySettings& settings, const Variant& variant);
[[nodiscard]] Frame frame_of(const EntrySettings& settings, const Variant& variant);

// What turns the pixels' directions into those of the scene: a reflection, or the identity.
[[nodiscard]] glm::dmat3 mirror_of(const EntrySettings& settings, const Variant& variant);

// The rotation of a variant, its view included, in the native frame; the identity where it has
// none. Error: usage (no rotation).
[[nodiscard]] Result<glm::dmat3> turn_of(const EntrySettings& settings, const Variant& variant);

[[nodiscard]] WindowKey window_of(const EntrySettings& settings, const Variant& variant);
[[nodiscard]] DominantPart dominant_of(const EntrySettings& settings, const Variant& variant);

// The entry's lights with their directions in the native frame.
[[nodiscard]] std::vector<AnalyticLight> native_lights(const EntrySettings& settings);

enum class MapLayout {
  equirect,
  cube,  // as `faces` says
  cube_vertical_cross,
  cube_horizontal_cross,
  cube_vertical_strip,
  cube_horizontal_strip,
  angular,
  mirror_ball,
  octahedral,
  octahedral_equal_area,
  cube_openexr,  // EXR's envmap CUBE
};
enum class CubeFaces { strip, files };  // six faces side by side, or a file each

struct MapRequest {
  Quantity kind = Quantity::irradiance;
  MapLayout layout = MapLayout::equirect;
  int width = 400;  // but for equirect: the edge of a face or of the square, as is height
  int height = 200;
  MapFileType format = MapFileType::exr;
  MapSamples samples = MapSamples::half;
  CubeFaces faces = CubeFaces::strip;
  double preview_stops = 0.0;  // exposure of a PNG
  std::string suffix;          // tells maps of one kind and layout apart
  SourceLoc loc;
};

// The layout of the pictures that a map is made of; cube_faces where there are six.
[[nodiscard]] Layout layout_of(const MapRequest& map);

// Whether the map's faces are named by the axes of a frame: those of all cubes but cube_openexr,
// whose frame is OpenEXR's.
[[nodiscard]] bool has_faces_of_frame(const MapRequest& map);

// A file for another program, for every panorama and variant.
struct ExportRequest {
  std::shared_ptr<const Profile> profile;  // with the options and the frame that are asked for
  std::string fingerprint;                 // profile_fingerprint() of it
  std::string suffix;                      // tells exports of one profile apart
  SourceLoc loc;
};

// Tables besides those of coefficients.
enum class FigureTable {
  quality,  // quality.csv: how well coefficients stand for their light (output/quality_table.h)
  lights,   // lights.csv: sun and dominant light of each panorama (output/light_table.h)
};

struct Manifest {
  std::filesystem::path path;
  std::filesystem::path output;
  std::vector<PanoramaEntry> entries;  // in the order of the tables
  std::vector<Variant> variants;       // at least one; {"plain"} where the manifest names none
  std::vector<Quantity> quantities;    // at least one, none twice
  std::vector<TableFormat> tables;     // none twice, as are the next; at least one of both
  std::vector<FigureTable> figure_tables;
  std::vector<MapRequest> maps;
  std::vector<ExportRequest> exports;
};

[[nodiscard]] bool asks_for(const Manifest& manifest, FigureTable table);

// Whether figures of quality are wanted of a panorama: for their table, or since its light is to be
// known to a higher degree than its coefficients'.
[[nodiscard]] bool wants_quality(const Manifest& manifest, const EntrySettings& settings);

// The faces of a cube in the order of a strip, as their files' names tell them: +x -x +y -y +z -z.
inline constexpr std::string_view kCubeFaceNames[] = {"px", "nx", "py", "ny", "pz", "nz"};

// The files of one map below the output folder: one, or six in the order of kCubeFaceNames.
//   maps/NAME[.VARIANT].KIND[.LAYOUT][.SUFFIX][.FACE].EXT
// with the variant only where the manifest has several.
[[nodiscard]] std::vector<std::string> map_files(const Manifest& manifest,
                                                 const PanoramaEntry& entry, const Variant& variant,
                                                 const MapRequest& map);

// The file of the entry's picture below the output folder, maps/NAME.picture.EXT, with its size.
// Precondition: it asks for one.
struct PictureFile {
  std::string name;
  int width = 0;
  int height = 0;
};
[[nodiscard]] PictureFile picture_file(const PanoramaEntry& entry);

// The file of one export below the output folder:
//   exports/NAME[.VARIANT].PROFILE[.SUFFIX].EXT
[[nodiscard]] std::string export_file(const Manifest& manifest, const PanoramaEntry& entry,
                                      const Variant& variant, const ExportRequest& request);

// Whether all panoramas have the degree that an export needs. Error: usage.
[[nodiscard]] Status check_export_degree(const Manifest& manifest, const ExportRequest& request);

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
