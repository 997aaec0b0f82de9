#include "scenes/hidden_labels.h"

#include <gtest/gtest.h>
#include <vtkCamera.h>
#include <vtkCommand.h>
#include <vtkNew.h>
#include <vtkTextActor.h>

#include <memory>

#include "scenes/stage.h"
#include "window/offscreen.h"

namespace shoal::viz {
namespace {

TEST(Meets, IsTrueOfSegmentsThroughABall) {
  const Mesh ball = sphere_mesh(16);
  EXPECT_TRUE(meets(ball, {3.0f, 0.1f, 0.2f}, {-3.0f, 0.1f, 0.2f}));
  EXPECT_TRUE(meets(ball, {3.0f, 0.1f, 0.2f}, {0.0f, 0.0f, 0.0f}));
  EXPECT_FALSE(meets(ball, {3.0f, 0.1f, 0.2f}, {1.1f, 0.1f, 0.2f})) << "ends before it";
  EXPECT_FALSE(meets(ball, {3.0f, 1.1f, 0.2f}, {-3.0f, 1.1f, 0.2f})) << "passes it";
  EXPECT_FALSE(meets(ball, {3.0f, 0.0f, 0.0f}, {4.0f, 0.0f, 0.0f})) << "leads away";
}

// Seen from +x, at a distance of 10 with a view angle of 60 degrees in 200 pixels, a pixel at the
// middle's plane is 2 * 10 * tan(30) / 200 = 0.0577 wide. A box at (-0.5, y, 0) is behind the ball
// while its inner edge is: the ball's shadow there has a radius of about 1.05.
TEST(HideBehind, GoesByTheViewsCameraAndTheBoxsCorners) {
  auto window = make_offscreen_window({200, 200});
  if (!window) GTEST_SKIP() << window.error().text();
  Stage stage(**window);
  vtkRenderer& view = stage.add_view({});
  vtkCamera& camera = *view.GetActiveCamera();
  camera.SetFocalPoint(0.0, 0.0, 0.0);
  camera.SetViewUp(0.0, 0.0, 1.0);
  camera.SetViewAngle(60.0);
  const auto ball = std::make_shared<const Mesh>(sphere_mesh(32));
  const auto is_seen = [&](const glm::vec3& middle, double half_width, double eye) {
    vtkNew<vtkTextActor> prop;
    camera.SetPosition(eye, 0.0, 0.0);
    hide_behind(view, *prop, {middle, {half_width, 2.0}, ball});
    view.InvokeEvent(vtkCommand::StartEvent);
    return prop->GetVisibility() != 0;
  };
  EXPECT_FALSE(is_seen({-1.2f, 0.0f, 0.0f}, 4.0, 10.0));
  EXPECT_TRUE(is_seen({-1.2f, 0.0f, 0.0f}, 4.0, -10.0)) << "from the other side";
  EXPECT_TRUE(is_seen({1.2f, 0.0f, 0.0f}, 4.0, 10.0));
  EXPECT_TRUE(is_seen({-0.5f, 1.4f, 0.0f}, 4.0, 10.0));
  EXPECT_FALSE(is_seen({-0.5f, 1.4f, 0.0f}, 10.0, 10.0)) << "a corner is covered";
}

}  // namespace
}  // namespace shoal::viz
