// What the window of `shoal view` shows, and what keys make of it. No VTK, no window.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

#include "library/library.h"
#include "scenes/scene.h"

namespace shoal::viz {

enum class DegreeWindow { none, hann };

struct ViewerState {
  SceneKind scene = SceneKind::lobes;
  std::size_t panorama = 0;
  SceneSettings settings;
  DegreeWindow window = DegreeWindow::none;
};

// What is left to do for a key once the state has changed.
enum class KeyEffect {
  nothing,     // the key has no meaning, or not here
  show,        // show the state
  reset_view,  // show it as it was before the mouse turned it
  toggle_help,
  tell_last_degree,  // there is none beyond the one that is shown
  save,              // a picture
  quit,
};

// Precondition: the library has panoramas.
[[nodiscard]] KeyEffect press_key(char key, const Library& library, ViewerState& state);

// The degree to which the state shows its panorama, or the basis.
[[nodiscard]] int shown_degree(const Library& library, const ViewerState& state);

// What to say where there is no degree beyond the one that is shown.
[[nodiscard]] std::string last_degree_text(const Library& library, const ViewerState& state);

// Whose picture it is: the panorama's full name; the library's where the scene shows none or all.
[[nodiscard]] std::string subject_name(const Library& library, const ViewerState& state);

struct KeyHelp {
  std::string_view keys;
  std::string_view meaning;
};

inline constexpr KeyHelp kKeyHelp[] = {
    {"n  p", "next and previous panorama, or page"},
    {"1 to 7", "scene: basis, lobes, sphere, degrees, lit, compare, contact"},
    {"+  -", "degree up and down"},
    {"w", "Hann window over the degrees on and off"},
    {"E  e", "exposure up and down by half a stop"},
    {"c", "channel: luminance, red, green, blue"},
    {"r", "view as it was before the mouse turned it"},
    {"s", "save the picture as NAME.SCENE.png here, numbered from the second on"},
    {"h", "these keys on and off"},
    {"q", "quit"},
    {"mouse", "left turns, middle moves, right or wheel comes nearer"},
};

}  // namespace shoal::viz
