#include "app/turned_cameras.h"

#include <vtkCollectionIterator.h>
#include <vtkRendererCollection.h>

#include <algorithm>
#include <glm/geometric.hpp>
#include <glm/gtc/type_ptr.hpp>
#include <glm/vec3.hpp>

namespace shoal::viz {
namespace {

struct Pose {
  glm::dvec3 eye;
  glm::dvec3 target;
  glm::dvec3 up;

  friend bool operator==(const Pose&, const Pose&) = default;
};

Pose pose_of(vtkCamera& camera) {
  return {glm::make_vec3(camera.GetPosition()), glm::make_vec3(camera.GetFocalPoint()),
          glm::make_vec3(camera.GetViewUp())};
}

// Distances are those of the view's size, so what was moved is told in them.
void carry_over(const Pose& start, const Pose& turned, vtkRenderer& view) {
  vtkCamera& camera = *view.GetActiveCamera();
  const Pose fresh = pose_of(camera);
  const double scale =
      glm::distance(fresh.eye, fresh.target) / glm::distance(start.eye, start.target);
  const glm::dvec3 target = fresh.target + scale * (turned.target - start.target);
  const glm::dvec3 eye = target + scale * (turned.eye - turned.target);
  camera.SetFocalPoint(target.x, target.y, target.z);
  camera.SetPosition(eye.x, eye.y, eye.z);
  camera.SetViewUp(turned.up.x, turned.up.y, turned.up.z);
  view.ResetCameraClippingRange();
}

}  // namespace

std::vector<TurnedCameras::Entry> TurnedCameras::entries_of(vtkRenderWindow& window) {
  std::vector<Entry> entries;
  vtkRendererCollection& all = *window.GetRenderers();
  for (int i = 0; i < all.GetNumberOfItems(); ++i) {
    auto* view = vtkRenderer::SafeDownCast(all.GetItemAsObject(i));
    if (!view->GetInteractive()) continue;
    const bool known = std::ranges::any_of(entries, [&](const Entry& entry) {
      return entry.view->GetActiveCamera() == view->GetActiveCamera();
    });
    if (known) continue;
    auto start = vtkSmartPointer<vtkCamera>::New();
    start->DeepCopy(view->GetActiveCamera());
    entries.push_back({view, start});
  }
  return entries;
}

void TurnedCameras::note(vtkRenderWindow& window) { entries_ = entries_of(window); }

void TurnedCameras::carry_over_to(vtkRenderWindow& window) {
  std::vector<Entry> fresh = entries_of(window);
  for (std::size_t i = 0; i < std::min(fresh.size(), entries_.size()); ++i) {
    const Pose start = pose_of(*entries_[i].start);
    const Pose turned = pose_of(*entries_[i].view->GetActiveCamera());
    if (turned != start) carry_over(start, turned, *fresh[i].view);
  }
  entries_ = std::move(fresh);
}

}  // namespace shoal::viz
