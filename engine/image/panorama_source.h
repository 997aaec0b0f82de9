// Panorama files as streams of row bands. One reader a format behind one interface.
//
// A source is immutable after opening and shared by the workers; each worker makes its own
// BandReader, whose buffers the returned bands point into.
#pragma once

#include <cstdint>
#include <filesystem>
#include <glm/mat3x3.hpp>
#include <memory>
#include <string>
#include <vector>

#include "core/result.h"
#include "core/row_band.h"
#include "image/chunk_codecs.h"

namespace shoal {

class ContentRecorder;

// How a Radiance texel's mantissa m is read; the peers differ (README, "Conventions").
enum class RgbeDecode {
  floor,   // m/256, as OpenImageIO, stb and cmft do
  center,  // (m + 1/2)/256, as Radiance itself and Filament do
};

// How the integers of an integer picture are meant. Files with float samples are linear.
enum class Encoding { srgb, linear };

struct ReadOptions {
  std::string layer;  // EXR: read layer.R, layer.G, layer.B; empty: R, G, B
  std::string part;   // EXR multi-part: a name or a number from 0; empty: the first with colour
  RgbeDecode rgbe_decode = RgbeDecode::floor;
  Encoding encoding = Encoding::srgb;
  int rows_per_band =
      0;  // a wish, rounded up to what the file's chunks allow; 0: the reader's choice
  std::shared_ptr<ContentRecorder> recorder;  // where given, is handed what is read of the file
};

// Which way the scanlines of a file run over the picture.
enum class ScanAxis {
  rows,     // a scanline is a row of the picture
  columns,  // a scanline is a column: bands are ranges of columns, `width` samples from top to
            // bottom
};

enum class PixelPositions {
  centers,    // half a pixel away from the border
  endpoints,  // the border pixels lie on the poles and on the seam (EXR envmap LATLONG), or on the
              // edges of the faces (CUBE)
};

// The layout that a file itself says its picture has (EXR's envmap, a DDS cube map).
enum class EnvironmentMap {
  unsaid,
  latlong,
  cube,        // EXR: six faces one below the other in its own frame, positions endpoints
  cube_strip,  // DDS: six square faces one below the other, +x -x +y -y +z -z as Direct3D has them
};

// Whether bands may be read in any order and by several readers at once.
enum class BandAccess { random, sequential };

struct PictureInfo {
  std::string format;  // for people: "OpenEXR half ZIP", "Radiance RGBE"
  int width = 0;       // of the picture as it is looked at, whichever way the file stores it
  int height = 0;
  int channel_count = 3;  // 3 or 1 (grey)
  PixelPositions positions = PixelPositions::centers;
  EnvironmentMap environment = EnvironmentMap::unsaid;

  ScanAxis scan_axis = ScanAxis::rows;
  // The samples of a scanline run from right to left (rows) or from bottom to top (columns).
  // Bands come in file order; each says which picture rows (or columns) it holds, ascending.
  bool samples_reversed = false;

  int band_count = 0;
  int rows_per_band = 0;  // most that a band has; scanlines, so columns where scan_axis says so
  BandAccess band_access = BandAccess::random;

  // From the file's samples to linear Rec.709: EXPOSURE, XYZ. Applied to coefficients.
  glm::dmat3 to_linear_rec709{1.0};

  std::vector<std::string> warnings;  // whole sentences without the file's name
};

class BandReader {
 public:
  virtual ~BandReader() = default;

  // Reads band `index`. The band's planes live until the next read. With BandAccess::sequential,
  // the indices must come in order from 0; `index` is otherwise free.
  // Errors: malformed, unreadable; `where` is file:row.
  virtual Result<RowBand> read(int index) = 0;
};

class PanoramaSource {
 public:
  virtual ~PanoramaSource() = default;
  [[nodiscard]] virtual const PictureInfo& info() const = 0;
  [[nodiscard]] virtual Result<std::unique_ptr<BandReader>> new_reader() const = 0;
};

// Opens a panorama and checks its header against the file's size, before anything is allocated.
// The format is told by the first bytes, not by the name. Errors: not_found, unreadable, malformed,
// unsupported (deep, no colour, absurd sizes), usage (no such layer or part).
Result<std::unique_ptr<PanoramaSource>> open_panorama(const std::filesystem::path& path,
                                                      const ReadOptions& options,
                                                      const ChunkCodecs& codecs);

// Larger pictures are refused: W or H above this, or more pixels than kMaxPixels.
inline constexpr int kMaxSide = 1 << 18;
inline constexpr std::int64_t kMaxPixels = std::int64_t{1} << 34;

}  // namespace shoal
