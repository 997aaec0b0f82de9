#include <gtest/gtest.h>
#include <vtkCamera.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>
#include <vector>

#include "library/viewpoint.h"
#include "scenes/actors.h"
#include "scenes/ball_picture.h"
#include "scenes/equirect.h"
#include "scenes/pictures.h"
#include "scenes/shared_camera.h"
#include "sphere/irradiance.h"
#include "viz/scenes/made_library.h"
#include "window/offscreen.h"
#include "window/picture_difference.h"

namespace shoal::viz {
namespace {

constexpr int kSide = 200;

// One of each kind: z up and y up, with and without a mirror.
std::vector<Frame> frames() {
  std::vector<Frame> frames;
  for (const char* name : {"native", "openexr", "three", "-y,+x,+z"}) {
    frames.push_back(*parse_frame(name));
  }
  return frames;
}

glm::dvec2 project(vtkRenderer& view, const glm::dvec3& point) {
  view.SetWorldPoint(point.x, point.y, point.z, 1.0);
  view.WorldToDisplay();
  return {view.GetDisplayPoint()[0], view.GetDisplayPoint()[1]};
}

// Where the light is, in the display's coordinates: the mean place of what is at least nine tenths
// as bright as the brightest.
glm::dvec2 bright_spot(const Picture& picture) {
  const auto brightness = [&](int i) { return static_cast<int>(picture.rgb[3 * i + 1]); };
  const int count = picture.size.width * picture.size.height;
  int most = 0;
  for (int i = 0; i < count; ++i) most = std::max(most, brightness(i));
  glm::dvec2 sum(0.0);
  double found = 0.0;
  for (int i = 0; i < count; ++i) {
    if (10 * brightness(i) < 9 * most) continue;
    sum += glm::dvec2(i % picture.size.width + 0.5,
                      picture.size.height - i / picture.size.width - 0.5);
    ++found;
  }
  return sum / found;
}

class Balls : public testing::Test {
 protected:
  void SetUp() override {
    auto window = make_offscreen_window({kSide, kSide});
    if (!window) GTEST_SKIP() << window.error().text();
    window_ = *window;
  }

  vtkSmartPointer<vtkRenderWindow> window_;
};

// A panorama with a light at half axis d of a frame, on a ball: what is bright is where the drawn
// axis d leaves the ball. Half axes that face the viewer can be seen. Within five hundredths of the
// ball's radius: the spot is curved and seen at a slant.
TEST_F(Balls, ShowLightWhereTheFramesAxisLeavesThem) {
  for (const Frame& frame : frames()) {
    int seen = 0;
    for (int index = 0; index < 6; ++index) {
      const glm::dvec3 axis = direction_of({index / 2, index % 2 == 0 ? 1 : -1});
      if (glm::dot(axis, viewer_direction(frame)) < 0.3) continue;
      ++seen;
      const glm::dvec3 native = glm::transpose(native_to_frame(frame)) * axis;
      Pixels light = synthesise(test::light_from(native, glm::dvec3(1.0), 12), 256, 128);
      const float peak = *std::ranges::max_element(light.rgb);
      Stage stage(*window_);
      vtkRenderer& view = stage.add_view({});
      add_ball(view, tone_mapped_picture(light, 0.7 / peak), frame);
      SharedCamera().look(view, frame, 1.1);
      const glm::dvec2 spot = bright_spot(take_picture(*window_));
      const double radius = kSide / (2.0 * 1.1 * 1.04);
      EXPECT_LT(glm::distance(spot, project(view, axis)), 0.05 * radius)
          << text_of(frame) << ' ' << index;
    }
    EXPECT_EQ(seen, 3) << text_of(frame);
  }
}

// The flat ball and the one of triangles, both seen from infinitely far: inside the same but for
// the texture's steps of 8 bits and what is between its texels; at the rim a pixel is covered in
// quarters or smoothly. A rim two pixels wide are 4 pi / 200 of the square's pixels.
TEST_F(Balls, AreTheSameFlat) {
  // Irradiance, as the contact sheet shows it, and enough of a constant that it is nowhere below
  // zero, where pictures have an edge.
  Coefficients light =
      apply_quantity(test::made_library().panoramas[0].coefficients, Quantity::irradiance_over_pi);
  for (auto& channel : light.channels) channel[0] += 1.0;
  const Picture texture = tone_mapped_picture(synthesise(light, 1024, 512), 0.6);
  for (const Frame& frame : frames()) {
    Stage stage(*window_);
    vtkRenderer& view = stage.add_view({});
    SharedCamera().look(view, frame, 1.0);
    add_ball(view, texture, frame);
    view.GetActiveCamera()->SetParallelProjection(true);
    // The flat ball has a margin of a pixel around it.
    view.GetActiveCamera()->SetParallelScale(0.5 * kSide / (0.5 * kSide - 1.0));
    const Picture drawn = take_picture(*window_);
    const Picture flat = ball_picture(light, frame, 0.6, kSide, theme::kBackground);
    const auto difference = compare_pictures(drawn, flat, 4);
    ASSERT_TRUE(difference);
    EXPECT_LT(difference->share, 4.0 * std::numbers::pi / kSide) << text_of(frame);
    int off = 0;
    for (int i = 0; i < kSide * kSide; ++i) {
      const glm::dvec2 place(i % kSide + 0.5 - 0.5 * kSide, i / kSide + 0.5 - 0.5 * kSide);
      if (glm::length(place) > 0.5 * kSide - 3.0) continue;
      int largest = 0;
      for (int c = 0; c < 3; ++c) {
        largest = std::max(largest, std::abs(drawn.rgb[3 * i + c] - flat.rgb[3 * i + c]));
      }
      EXPECT_LE(largest, 24) << text_of(frame);
      if (largest > 4) ++off;
    }
    // Around the pole, where the texture's smaller versions take whole rows together.
    EXPECT_LT(off, kSide * kSide / 1000) << text_of(frame);
  }
}

}  // namespace
}  // namespace shoal::viz
