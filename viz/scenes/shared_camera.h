// One camera for several views of one size, so that they turn together.
#pragma once

#include <vtkCamera.h>
#include <vtkRenderer.h>

#include "sphere/frame.h"

namespace shoal::viz {

class SharedCamera {
 public:
  // Aims the camera with the first view, as aim_camera does, and gives it to the view. To be called
  // before anything stands in the view, since labels keep the camera that they were made for.
  void look(vtkRenderer& view, const Frame& frame, double radius);

 private:
  vtkCamera* camera_ = nullptr;  // of the first view, which lives as long as the others
};

}  // namespace shoal::viz
