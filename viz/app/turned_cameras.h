// How the mouse has turned the views of a window, kept while the window is filled anew.
#pragma once

#include <vtkCamera.h>
#include <vtkRenderWindow.h>
#include <vtkRenderer.h>
#include <vtkSmartPointer.h>

#include <vector>

namespace shoal::viz {

class TurnedCameras {
 public:
  // Notes the cameras of a window that was just filled.
  void note(vtkRenderWindow& window);

  // What the mouse has done since then, done to the window's cameras, which belong to the same
  // scene shown anew: another panorama, degree or size. Cameras that nobody turned stay as they
  // are.
  void carry_over_to(vtkRenderWindow& window);

 private:
  struct Entry {
    vtkSmartPointer<vtkRenderer> view;  // the first that has the camera
    vtkSmartPointer<vtkCamera> start;   // as it was
  };

  [[nodiscard]] static std::vector<Entry> entries_of(vtkRenderWindow& window);

  std::vector<Entry> entries_;
};

}  // namespace shoal::viz
