#include "app/viewer_style.h"

#include <vtkCommand.h>
#include <vtkObjectFactory.h>
#include <vtkRenderWindowInteractor.h>
#include <vtkRenderer.h>

namespace shoal::viz {

vtkStandardNewMacro(ViewerStyle);

void ViewerStyle::stop() {
  if (State != VTKIS_NONE) StopState();
  SetCurrentRenderer(nullptr);
}

void ViewerStyle::OnChar() { on_key(Interactor->GetKeyCode()); }

// The base class picks the view under the mouse at every move, so that a drag over the edge of one
// would go on with its neighbour.
void ViewerStyle::OnMouseMove() {
  switch (State) {
    case VTKIS_ROTATE:
      Rotate();
      break;
    case VTKIS_PAN:
      Pan();
      break;
    case VTKIS_DOLLY:
      Dolly();
      break;
    case VTKIS_SPIN:
      Spin();
      break;
    default:
      return;
  }
  InvokeEvent(vtkCommand::InteractionEvent);
}

// Where the mouse is over no view, VTK would take any layer of the stage for one.
bool ViewerStyle::is_over_view() const {
  const int* place = Interactor->GetEventPosition();
  vtkRenderer* under = Interactor->FindPokedRenderer(place[0], place[1]);
  return under && under->GetInteractive() && under->IsInViewport(place[0], place[1]);
}

void ViewerStyle::OnLeftButtonDown() {
  if (is_over_view()) Superclass::OnLeftButtonDown();
}

void ViewerStyle::OnMiddleButtonDown() {
  if (is_over_view()) Superclass::OnMiddleButtonDown();
}

void ViewerStyle::OnRightButtonDown() {
  if (is_over_view()) Superclass::OnRightButtonDown();
}

void ViewerStyle::OnMouseWheelForward() {
  if (is_over_view()) Superclass::OnMouseWheelForward();
}

void ViewerStyle::OnMouseWheelBackward() {
  if (is_over_view()) Superclass::OnMouseWheelBackward();
}

}  // namespace shoal::viz
