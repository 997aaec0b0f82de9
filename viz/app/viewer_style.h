// How the window of `shoal view` takes mouse and keys.
#pragma once

#include <vtkInteractorStyleTrackballCamera.h>

#include <functional>

namespace shoal::viz {

// VTK's trackball camera, of the view in which a button was pressed; words and flat pictures do not
// turn. Keys go to `on_key` alone: none of those that VTK knows itself (w, s, p, e, 3, ...) acts.
class ViewerStyle : public vtkInteractorStyleTrackballCamera {
 public:
  static ViewerStyle* New();
  vtkTypeMacro(ViewerStyle, vtkInteractorStyleTrackballCamera);

  std::function<void(char)> on_key;

  // Lets go of what the mouse is dragging.
  void stop();

  void OnChar() override;
  void OnMouseMove() override;
  void OnLeftButtonDown() override;
  void OnMiddleButtonDown() override;
  void OnRightButtonDown() override;
  void OnMouseWheelForward() override;
  void OnMouseWheelBackward() override;

 protected:
  ViewerStyle() = default;
  ~ViewerStyle() override = default;

 private:
  [[nodiscard]] bool is_over_view() const;
};

}  // namespace shoal::viz
