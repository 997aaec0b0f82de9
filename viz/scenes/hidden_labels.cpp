#include "scenes/hidden_labels.h"

#include <vtkCamera.h>
#include <vtkCommand.h>
#include <vtkNew.h>
#include <vtkSmartPointer.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/gtc/type_ptr.hpp>
#include <numbers>
#include <utility>

namespace shoal::viz {
namespace {

// Moeller and Trumbore, "Fast, Minimum Storage Ray/Triangle Intersection", JGT 2(1), 1997.
bool meets(const glm::vec3& start, const glm::vec3& way, const glm::vec3& p, const glm::vec3& q,
           const glm::vec3& r) {
  const glm::vec3 edge = q - p;
  const glm::vec3 other = r - p;
  const glm::vec3 across = glm::cross(way, other);
  const float volume = glm::dot(edge, across);
  if (volume == 0.0f) return false;
  const glm::vec3 from = start - p;
  const float u = glm::dot(from, across) / volume;
  if (u < 0.0f || u > 1.0f) return false;
  const glm::vec3 turned = glm::cross(from, edge);
  const float v = glm::dot(way, turned) / volume;
  if (v < 0.0f || u + v > 1.0f) return false;
  const float along = glm::dot(other, turned) / volume;
  return along > 0.0f && along < 1.0f;
}

// What the view's camera makes of the box.
bool is_covered(vtkRenderer& view, const FacingBox& box) {
  vtkCamera& camera = *view.GetActiveCamera();
  const glm::dvec3 eye = glm::make_vec3(camera.GetPosition());
  const glm::dvec3 middle(box.middle);
  const glm::dvec3 ahead = glm::make_vec3(camera.GetDirectionOfProjection());
  const glm::dvec3 right =
      glm::normalize(glm::cross(ahead, glm::dvec3(glm::make_vec3(camera.GetViewUp()))));
  const glm::dvec3 up = glm::cross(right, ahead);
  const double half_angle = 0.5 * camera.GetViewAngle() * std::numbers::pi / 180.0;
  const double pixel =
      2.0 * std::tan(half_angle) * glm::dot(middle - eye, ahead) / std::max(1, view.GetSize()[1]);
  for (const glm::dvec2 corner :
       {glm::dvec2(0.0), {-1.0, -1.0}, {1.0, -1.0}, {-1.0, 1.0}, {1.0, 1.0}}) {
    const glm::dvec2 shift = pixel * corner * box.half;
    const glm::dvec3 end = middle + shift.x * right + shift.y * up;
    if (meets(*box.hidden_by, glm::vec3(eye), glm::vec3(end))) return true;
  }
  return false;
}

class HideBehind : public vtkCommand {
 public:
  static HideBehind* New() { return new HideBehind; }

  void Execute(vtkObject* view, unsigned long, void*) override {
    prop->SetVisibility(!is_covered(*static_cast<vtkRenderer*>(view), box));
  }

  vtkSmartPointer<vtkProp> prop;
  FacingBox box;
};

}  // namespace

bool meets(const Mesh& mesh, const glm::vec3& a, const glm::vec3& b) {
  return std::ranges::any_of(mesh.triangles, [&](const auto& corners) {
    return meets(a, b - a, mesh.positions[corners[0]], mesh.positions[corners[1]],
                 mesh.positions[corners[2]]);
  });
}

void hide_behind(vtkRenderer& view, vtkProp& prop, FacingBox box) {
  const auto command = vtkSmartPointer<HideBehind>::New();
  command->prop = &prop;
  command->box = std::move(box);
  view.AddObserver(vtkCommand::StartEvent, command);
}

}  // namespace shoal::viz
