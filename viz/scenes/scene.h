// The seven scenes: each fills a render window with what there is to see of a library.
#pragma once

#include <vtkRenderWindow.h>

#include <cstddef>
#include <optional>
#include <string_view>

#include "core/result.h"
#include "library/library.h"
#include "library/pixels.h"
#include "sphere/frame.h"
#include "sphere/irradiance.h"

namespace shoal::viz {

enum class SceneKind { basis, lobes, sphere, degrees, lit, compare, contact };

inline constexpr SceneKind kAllScenes[] = {SceneKind::basis,   SceneKind::lobes, SceneKind::sphere,
                                           SceneKind::degrees, SceneKind::lit,   SceneKind::compare,
                                           SceneKind::contact};

// "basis", "lobes", ...
[[nodiscard]] std::string_view name_of(SceneKind kind);
[[nodiscard]] Result<SceneKind> parse_scene(std::string_view name);  // error: usage, nearest name

// Which number of a colour a lobe shows.
enum class Channel { luminance, red, green, blue };

// How a lobe surface is coloured.
enum class LobeColour { sign, light };  // diverging by sign, or the light's own colour

// Cells of a contact sheet's page.
struct Grid {
  int columns = 1;
  int rows = 1;
};

// What a page holds where no grid is asked for.
inline constexpr int kCellsOfPage = 20;

struct SceneSettings {
  std::optional<int> degree;               // shown; all that there is where it is not given
  Quantity quantity = Quantity::radiance;  // of lobes, degrees and compare
  Channel channel = Channel::luminance;
  LobeColour colour = LobeColour::sign;
  Frame frame;                  // whose axes are drawn and named
  double exposure_stops = 0.0;  // on top of the automatic one
  std::optional<Grid> grid;     // of a contact sheet; else the one with the largest pictures, of as
                                // many cells as the library needs, kCellsOfPage at most
  int page = 0;
};

// What a scene is made of. Pixels may be empty where a panorama has no file.
struct SceneInput {
  const Library* library = nullptr;
  std::size_t current = 0;
  std::optional<std::size_t> other;  // compare: the second panorama or variant
  SceneSettings settings;
  PixelCache* pixels = nullptr;  // never null
};

// Removes what the window shows and fills it with the scene. The window may be rendered, turned by
// the mouse and filled again. Errors: usage (nothing to compare with, a page that does not exist).
[[nodiscard]] Status show_scene(SceneKind kind, const SceneInput& input, vtkRenderWindow& window);

// Cells of a page, and pages that a contact sheet of the library has.
[[nodiscard]] int contact_cell_count(const SceneSettings& settings);
[[nodiscard]] int contact_page_count(const Library& library, const SceneSettings& settings);

}  // namespace shoal::viz
