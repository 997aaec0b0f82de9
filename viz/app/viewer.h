// The window of `shoal view`.
#pragma once

#include <cstddef>
#include <optional>

#include "library/library.h"
#include "library/pixels.h"
#include "scenes/scene.h"
#include "window/picture.h"

namespace shoal::viz {

// What the window shows first.
struct ViewerStart {
  SceneKind scene = SceneKind::lobes;
  std::size_t panorama = 0;
  std::optional<std::size_t> other;  // compare: what with; its own pixels where nothing is
  SceneSettings settings;
  PictureSize size;
};

// Opens a window of the X server that DISPLAY names and returns when it is closed. Precondition:
// check_display() found the server, and the library has a panorama.
void run_viewer(const Library& library, PixelCache& pixels, const ViewerStart& start);

}  // namespace shoal::viz
