#include "window/offscreen.h"

#include <vtkNew.h>
#include <vtkUnsignedCharArray.h>

#include <algorithm>
#include <string>

#include "window/egl_window.h"

namespace shoal::viz {
namespace {

using Window = vtkSmartPointer<vtkRenderWindow>;

Result<Window> make_surfaceless_window() {
  SHOAL_ASSIGN_OR_RETURN(window, EglWindow::create());
  return Window(window);
}

Result<Window> make_x_window() {
  SHOAL_RETURN_IF_ERROR(check_display());
  auto window = Window::New();
  window->SetShowWindow(false);
  window->SetUseOffScreenBuffers(true);
  return window;
}

Result<Window> make_window(OffscreenWay way) {
  if (way == OffscreenWay::surfaceless) return make_surfaceless_window();
  if (way == OffscreenWay::x_display) return make_x_window();
  auto surfaceless = make_surfaceless_window();
  if (surfaceless) return surfaceless;
  auto on_display = make_x_window();
  if (on_display) return on_display;
  return Error{
      ErrorCode::unsupported,
      "nothing here can draw: " + surfaceless.error().what + ", and " + on_display.error().what, "",
      "install Mesa's EGL (libegl1, libegl-mesa0), or run under xvfb-run"};
}

}  // namespace

Result<Window> make_offscreen_window(PictureSize size, OffscreenWay way) {
  SHOAL_ASSIGN_OR_RETURN(window, make_window(way));
  window->SetSize(size.width, size.height);
  window->SetMultiSamples(kSampleCount);
  window->SetDPI(72);  // a point of type is a pixel, whatever the monitor
  return window;
}

Picture take_picture(vtkRenderWindow& window) {
  window.Render();
  const int* size = window.GetSize();
  Picture picture{{size[0], size[1]}, {}};
  vtkNew<vtkUnsignedCharArray> pixels;
  window.GetPixelData(0, 0, size[0] - 1, size[1] - 1, 0, pixels);
  const std::size_t row_size = 3 * static_cast<std::size_t>(size[0]);
  picture.rgb.resize(row_size * size[1]);
  for (int row = 0; row < size[1]; ++row) {  // OpenGL's rows start at the bottom
    std::copy_n(pixels->GetPointer(0) + row_size * (size[1] - 1 - row), row_size,
                picture.rgb.data() + row_size * row);
  }
  return picture;
}

}  // namespace shoal::viz
