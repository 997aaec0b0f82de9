// What the window of `shoal view` shows beside scenes: which keys there are, what became of a
// picture that was saved, and why a scene fails.
#pragma once

#include <vtkRenderWindow.h>

#include <string>

#include "core/result.h"
#include "scenes/stage.h"

namespace shoal::viz {

// A card with all keys over what the window shows; the sheet's take_away() removes it.
[[nodiscard]] Stage show_help(vtkRenderWindow& window);

// A card with a few words at the bottom of what the window shows; take_away() removes it.
[[nodiscard]] Stage show_notice(const std::string& text, vtkRenderWindow& window);

// In place of a scene.
void show_failure(const std::string& title, const std::string& subject, const Error& error,
                  vtkRenderWindow& window);

}  // namespace shoal::viz
