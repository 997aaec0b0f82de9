#include "scenes/shared_camera.h"

#include <glm/geometric.hpp>

#include "scenes/actors.h"

namespace shoal::viz {
namespace {

glm::vec3 direction_of(const SignedAxis& axis) {
  glm::vec3 direction(0.0f);
  direction[axis.axis] = static_cast<float>(axis.sign);
  return direction;
}

}  // namespace

glm::vec3 lit_side(const Frame& frame) {
  const auto side = static_cast<float>(frame.right.sign) * direction_of(frame.right);
  return glm::normalize(direction_of(frame.center) + 0.55f * side + 0.42f * direction_of(frame.up));
}

void SharedCamera::look(vtkRenderer& view, const Frame& frame, double radius) {
  if (camera_ == nullptr) {
    aim_camera(view, frame, radius);
    camera_ = view.GetActiveCamera();
    const double distance = camera_->GetDistance();
    const glm::dvec3 eye = distance * glm::dvec3(lit_side(frame));
    camera_->SetPosition(eye.x, eye.y, eye.z);
    const glm::dvec3 up(direction_of(frame.up));
    camera_->SetViewUp(up.x, up.y, up.z);
    camera_->OrthogonalizeViewUp();
  }
  view.SetActiveCamera(camera_);
}

}  // namespace shoal::viz
