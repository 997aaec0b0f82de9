// What there is to look at: panoramas with their coefficients, from a store, a table or files.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/result.h"
#include "library/light_change.h"
#include "sphere/coefficients.h"
#include "sphere/frame.h"
#include "sphere/irradiance.h"
#include "sphere/layout.h"

namespace shoal::viz {

// What the store knows of the pixels.
struct PixelFigures {
  std::string format;  // "Radiance RGBE"
  int width = 0;
  int height = 0;
  std::int64_t pixel_count = 0;
  std::int64_t nonfinite_count = 0;
  std::int64_t negative_count = 0;
  std::int64_t clamped_count = 0;
  std::array<double, 3> minimum{};
  std::array<double, 3> maximum{};
  std::array<double, 3> mean{};
};

// Figures of README, "The table of quality". One that the light does not have is empty, and so are
// the errors where `shoal run` was not asked for them (`quality:`).
struct QualityFigures {
  std::optional<double> rms_error;  // of irradiance, relative
  std::optional<double> max_error;
  std::optional<double> minimum_irradiance;
  double negative_fraction = 0.0;
  std::optional<double> contrast;
  std::optional<double> directionality;
  std::optional<double> key_temperature;  // kelvin
  std::optional<double> fill_temperature;
};

struct Panorama {
  std::string name;
  std::string variant;         // empty: as it was projected
  std::filesystem::path file;  // where its pixels are, the painted ones of an entry without a file;
                               // empty where nobody says
  Layout layout = Layout::equirect;  // of the file, where the store says another one
  std::string recipe;  // what they can be painted of where there is no file: an entry of a
                       // manifest, less its braces and name; empty where they cannot
  Quantity quantity = Quantity::radiance;
  Coefficients coefficients;  // of `quantity`, native frame, linear Rec.709
  std::optional<PixelFigures> pixels;
  std::optional<QualityFigures> quality;  // what the store has
  LightChange change;  // what a variant, or the entry's exposure, rotation and so on, makes of the
                       // pixels' light
  Frame frame;         // that a table told the coefficients in
  // All that this table holds of it, as it stands there: in `frame`.
  std::map<Quantity, Coefficients> told;
  std::vector<std::string> tags;
  std::vector<std::string> warnings;
};

// A panorama that the store says failed.
struct FailedPanorama {
  std::string name;
  std::string error;
  std::filesystem::path file = {};  // where its pixels are
};

struct Library {
  std::string title;  // of a report: the folder's or the table's name
  std::vector<Panorama> panoramas;
  std::vector<FailedPanorama> failed;
  std::vector<std::filesystem::path> frameless;  // CSV tables whose frames nothing tells
};

struct LoadSettings {
  std::optional<int> degree;  // of panoramas that are projected now; 2 where it is not given
  Frame table_frame;          // of CSV tables whose frames nothing tells
};

// `source` is an output folder of `shoal run` (its shoal.db is read), a store, a CSV or JSON table,
// a panorama, or a folder or several of panoramas; panoramas are projected by the program `shoal`,
// which lies beside shoal-viz or in PATH. Panoramas come in the order of the table or of the names.
// The frames of a run's coefficients.csv are told by the store beside it, or by coefficients.json.
// Errors: not_found, unreadable, malformed, unsupported, usage (a manifest), each with what to do
// next.
[[nodiscard]] Result<Library> load_library(const std::vector<std::filesystem::path>& sources,
                                           const LoadSettings& settings = {});

// The radiance behind a panorama's coefficients. What the clamped cosine took away, odd degrees
// above 1, stays away.
[[nodiscard]] Coefficients radiance_of(const Panorama& panorama);

// Of a quantity in a frame: the table's own numbers, to the last bit, where it tells them in this
// frame, or the radiance that they are made of.
[[nodiscard]] Coefficients coefficients_in(const Panorama& panorama, Quantity quantity,
                                           const Frame& frame);

// What tables of `shoal run` call the variant that has no name here.
inline constexpr std::string_view kPlainVariant = "plain";

// "NAME" or "NAME.VARIANT": of pictures and their files.
[[nodiscard]] std::string full_name(const Panorama& panorama);

// "plain" where the panorama is as it was projected.
[[nodiscard]] std::string variant_of(const Panorama& panorama);

// "NAME.VARIANT", "NAME.plain" included: what chooses that one alone.
[[nodiscard]] std::string variant_name(const Panorama& panorama);

// The indices of the panoramas that a shell pattern chooses, in their order: by a name all variants
// that it has, by a variant_name() that one. A text that is somebody's name is that name alone,
// though it could be a pattern, too.
[[nodiscard]] std::vector<std::size_t> find_panoramas(const Library& library,
                                                      const std::string& pattern);

// The frame that all panoramas are told in; the native one where they are told in several.
[[nodiscard]] Frame frame_of(const Library& library);

// How many there are: "18 panoramas", "18 panoramas, 2 variants each", "18 panoramas, 20 variants
// in all".
[[nodiscard]] std::string count_text(const Library& library);

// The library with these panoramas alone, in this order; what failed stays with it.
[[nodiscard]] Library part_of(const Library& library, std::span<const std::size_t> panoramas);

}  // namespace shoal::viz
