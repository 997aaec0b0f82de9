#include "window/egl_window.h"

#include <EGL/eglext.h>
#include <GL/gl.h>
#include <dlfcn.h>
#include <vtkObjectFactory.h>
#include <vtkOpenGLState.h>

#include <cstring>
#include <string>
#include <utility>

// VTK calls glewInit. A GLEW that was built for GLX loads every function and then reports, in a
// process without an X display, that it found no GLX (4, GLEW_ERROR_NO_GLX_DISPLAY), which VTK
// takes for a failure. The program's own glewInit comes first in the search order and calls GLEW's.
extern "C" __attribute__((visibility("default"))) unsigned int glewInit() {
  constexpr unsigned int kOk = 0;
  constexpr unsigned int kNoVersion = 1;
  constexpr unsigned int kNoGlxDisplay = 4;
  using Function = unsigned int (*)();
  const auto real = reinterpret_cast<Function>(::dlsym(RTLD_NEXT, "glewInit"));
  if (real == nullptr) return kNoVersion;
  const unsigned int status = real();
  return status == kNoGlxDisplay ? kOk : status;
}

namespace shoal::viz {
namespace {

Error unsupported(std::string what) {
  return Error{ErrorCode::unsupported, std::move(what), "", ""};
}

// Initialised once and never ended: windows come and go, and other libraries may use it too.
EGLDisplay surfaceless_display() {
  static const EGLDisplay display = [] {
    const char* extensions = eglQueryString(EGL_NO_DISPLAY, EGL_EXTENSIONS);
    const auto get_display = reinterpret_cast<PFNEGLGETPLATFORMDISPLAYEXTPROC>(
        eglGetProcAddress("eglGetPlatformDisplayEXT"));
    if (extensions == nullptr || get_display == nullptr) return EGL_NO_DISPLAY;
    // Mesa's name first; drivers that lack it offer their devices instead.
    for (const auto& [name, platform] :
         {std::pair("EGL_MESA_platform_surfaceless", EGL_PLATFORM_SURFACELESS_MESA),
          std::pair("EGL_EXT_platform_device", EGL_PLATFORM_DEVICE_EXT)}) {
      if (std::strstr(extensions, name) == nullptr) continue;
      const EGLDisplay candidate = get_display(platform, EGL_DEFAULT_DISPLAY, nullptr);
      if (candidate != EGL_NO_DISPLAY && eglInitialize(candidate, nullptr, nullptr)) {
        return candidate;
      }
    }
    return EGL_NO_DISPLAY;
  }();
  return display;
}

EGLContext make_context(EGLDisplay display) {
  if (!eglBindAPI(EGL_OPENGL_API)) return EGL_NO_CONTEXT;
  const EGLint config_wish[] = {EGL_SURFACE_TYPE, EGL_PBUFFER_BIT, EGL_RENDERABLE_TYPE,
                                EGL_OPENGL_BIT, EGL_NONE};
  EGLConfig config = nullptr;
  EGLint config_count = 0;
  if (!eglChooseConfig(display, config_wish, &config, 1, &config_count) || config_count == 0) {
    return EGL_NO_CONTEXT;
  }
  const EGLint context_wish[] = {EGL_CONTEXT_MAJOR_VERSION,
                                 3,
                                 EGL_CONTEXT_MINOR_VERSION,
                                 2,
                                 EGL_CONTEXT_OPENGL_PROFILE_MASK,
                                 EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT,
                                 EGL_NONE};
  return eglCreateContext(display, config, EGL_NO_CONTEXT, context_wish);
}

}  // namespace

vtkStandardNewMacro(EglWindow);

Result<vtkSmartPointer<EglWindow>> EglWindow::create() {
  const EGLDisplay display = surfaceless_display();
  if (display == EGL_NO_DISPLAY) return unsupported("EGL has no display without a window system");
  const EGLContext context = make_context(display);
  if (context == EGL_NO_CONTEXT) return unsupported("EGL has no OpenGL 3.2");
  if (!eglMakeCurrent(display, EGL_NO_SURFACE, EGL_NO_SURFACE, context)) {
    eglDestroyContext(display, context);
    return unsupported("EGL cannot draw without a surface");
  }
  auto window = vtkSmartPointer<EglWindow>::Take(New());
  window->display_ = display;
  window->context_ = context;
  window->set_state_of_windows();
  return window;
}

// VTK draws in somebody else's context with the state that it finds, OpenGL's own, where in a
// window of its own it begins with another; then equally deep things would lie on one another the
// other way round.
void EglWindow::set_state_of_windows() {
  OpenGLInit();
  vtkOpenGLState& state = *GetState();
  state.Reset();  // what it believes becomes what is
  state.vtkglDepthFunc(GL_LEQUAL);
  for (const unsigned int on : {GL_DEPTH_TEST, GL_SCISSOR_TEST, GL_BLEND}) state.vtkglEnable(on);
  state.vtkglBlendFuncSeparate(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA, GL_ONE,
                               GL_ONE_MINUS_SRC_ALPHA);
}

EglWindow::~EglWindow() {
  Finalize();  // VTK's resources go while their context is still there
  if (context_ == EGL_NO_CONTEXT) return;
  ReleaseCurrent();
  eglDestroyContext(display_, context_);
}

void EglWindow::MakeCurrent() {
  eglMakeCurrent(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, context_);
}

void EglWindow::ReleaseCurrent() {
  if (IsCurrent()) eglMakeCurrent(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
}

bool EglWindow::IsCurrent() { return eglGetCurrentContext() == context_; }

}  // namespace shoal::viz
