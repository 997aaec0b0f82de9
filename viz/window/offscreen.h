// A render window that needs no display.
#pragma once

#include <vtkRenderWindow.h>
#include <vtkSmartPointer.h>

#include "core/result.h"
#include "window/picture.h"

namespace shoal::viz {

enum class OffscreenWay {
  automatic,    // surfaceless EGL where it works, X where there is a display
  surfaceless,  // EGL without any window system
  x_display,    // an invisible window of the X server
};

// Whether the X server that DISPLAY names answers and can draw OpenGL. Asked before VTK opens a
// window, because VTK ends the process where it cannot.
[[nodiscard]] Status check_display();

// Samples a pixel, so that edges are smooth. What every window of shoal-viz is drawn with.
inline constexpr int kSampleCount = 4;

// Error: unsupported, in one sentence, where none of the ways works; VTK is never let to abort.
[[nodiscard]] Result<vtkSmartPointer<vtkRenderWindow>> make_offscreen_window(
    PictureSize size, OffscreenWay way = OffscreenWay::automatic);

// Renders the window and reads it back. The same scene gives the same bytes.
[[nodiscard]] Picture take_picture(vtkRenderWindow& window);

}  // namespace shoal::viz
