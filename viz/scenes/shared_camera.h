// One camera for several views of one size, so that they turn together.
#pragma once

#include <vtkCamera.h>
#include <vtkRenderer.h>

#include <glm/vec3.hpp>

#include "sphere/frame.h"

namespace shoal::viz {

// From where things that light falls on are seen: from before them, where the panorama's centre is,
// so that what is lit from there is what one sees; a little from above and from the side on which a
// horizontal axis comes towards the viewer. Of unit length.
[[nodiscard]] glm::vec3 lit_side(const Frame& frame);

class SharedCamera {
 public:
  // Aims the camera with the first view, as aim_camera does, and gives it to the view. To be called
  // before anything stands in the view, since labels keep the camera that they were made for.
  void look(vtkRenderer& view, const Frame& frame, double radius);

  // The same from the lit side.
  void look_at_lit_side(vtkRenderer& view, const Frame& frame, double radius);

 private:
  vtkCamera* camera_ = nullptr;  // of the first view, which lives as long as the others
};

}  // namespace shoal::viz
