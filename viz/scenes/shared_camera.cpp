#include "scenes/shared_camera.h"

#include "scenes/actors.h"

namespace shoal::viz {
void SharedCamera::look(vtkRenderer& view, const Frame& frame, double radius) {
  if (camera_ == nullptr) {
    aim_camera(view, frame, radius);
    camera_ = view.GetActiveCamera();
  }
  view.SetActiveCamera(camera_);
}

}  // namespace shoal::viz
