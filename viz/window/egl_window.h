// A render window of an EGL context that has neither a window system nor a surface.
//
// Distributions build VTK for X alone, where a window without a display ends the process. This one
// lends VTK a context instead and draws into VTK's own framebuffers.
#pragma once

#include <EGL/egl.h>
#include <vtkGenericOpenGLRenderWindow.h>
#include <vtkSmartPointer.h>

#include "core/result.h"

namespace shoal::viz {

class EglWindow : public vtkGenericOpenGLRenderWindow {
 public:
  vtkTypeMacro(EglWindow, vtkGenericOpenGLRenderWindow);

  // Error: unsupported, where EGL has no display that needs no surface, or no OpenGL 3.2.
  static Result<vtkSmartPointer<EglWindow>> create();

  void MakeCurrent() override;
  void ReleaseCurrent() override;
  bool IsCurrent() override;
  int SupportsOpenGL() override { return 1; }
  vtkTypeBool IsDirect() override { return 1; }

 protected:
  EglWindow() = default;
  ~EglWindow() override;

 private:
  static EglWindow* New();

  void set_state_of_windows();

  EGLDisplay display_ = EGL_NO_DISPLAY;
  EGLContext context_ = EGL_NO_CONTEXT;
};

}  // namespace shoal::viz
