#include "scenes/shared_camera.h"

#include <glm/geometric.hpp>

#include "scenes/actors.h"

namespace shoal::viz {
glm::vec3 lit_side(const Frame& frame) {
  const glm::dvec3 side = direction_of({frame.right.axis, 1});
  return glm::vec3(
      glm::normalize(direction_of(frame.center) + 0.55 * side + 0.42 * direction_of(frame.up)));
}

void SharedCamera::look(vtkRenderer& view, const Frame& frame, double radius) {
  if (camera_ == nullptr) {
    aim_camera(view, frame, radius);
    camera_ = view.GetActiveCamera();
  }
  view.SetActiveCamera(camera_);
}

void SharedCamera::look_at_lit_side(vtkRenderer& view, const Frame& frame, double radius) {
  const bool is_first = camera_ == nullptr;
  look(view, frame, radius);
  if (!is_first) return;
  const glm::dvec3 eye = camera_->GetDistance() * glm::dvec3(lit_side(frame));
  camera_->SetPosition(eye.x, eye.y, eye.z);
  const glm::dvec3 up = direction_of(frame.up);
  camera_->SetViewUp(up.x, up.y, up.z);
  camera_->OrthogonalizeViewUp();
}

}  // namespace shoal::viz
