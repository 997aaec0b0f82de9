#include <X11/Xlib.h>
#undef Status  // Xlib's name for int

#include <cstdlib>
#include <string>

#include "window/offscreen.h"

namespace shoal::viz {

Status check_display() {
  const auto unsupported = [](std::string what) {
    return Error{ErrorCode::unsupported, std::move(what), "", ""};
  };
  const char* name = std::getenv("DISPLAY");
  if (name == nullptr || *name == '\0') {
    return unsupported("there is no display: DISPLAY is not set");
  }
  // The connection stays open: an X server whose last client leaves may start afresh, and refuses
  // in the meantime the connection that VTK is about to make.
  static Display* display = nullptr;
  if (display == nullptr || std::string(XDisplayString(display)) != name) {
    display = XOpenDisplay(name);
  }
  if (display == nullptr) {
    return unsupported("the display " + std::string(name) + " does not answer");
  }
  int opcode = 0, event = 0, error = 0;
  if (!XQueryExtension(display, "GLX", &opcode, &event, &error)) {
    return unsupported("the display " + std::string(name) + " has no OpenGL");
  }
  return {};
}

}  // namespace shoal::viz
