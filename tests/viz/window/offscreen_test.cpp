#include "window/offscreen.h"

#include <gtest/gtest.h>
#include <vtkActor.h>
#include <vtkActor2D.h>
#include <vtkCamera.h>
#include <vtkNew.h>
#include <vtkPlaneSource.h>
#include <vtkPolyDataMapper.h>
#include <vtkPolyDataMapper2D.h>
#include <vtkProperty.h>
#include <vtkProperty2D.h>
#include <vtkRenderer.h>
#include <vtkSphereSource.h>

#include <array>
#include <cstdlib>

namespace shoal::viz {
namespace {

// An orange ball in the upper half, on blue.
void fill(vtkRenderWindow& window) {
  vtkNew<vtkSphereSource> source;
  source->SetCenter(0.0, 0.5, 0.0);
  source->SetRadius(0.3);
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputConnection(source->GetOutputPort());
  vtkNew<vtkActor> actor;
  actor->SetMapper(mapper);
  actor->GetProperty()->SetColor(1.0, 0.5, 0.0);
  actor->GetProperty()->LightingOff();
  vtkNew<vtkRenderer> renderer;
  renderer->SetBackground(0.0, 0.0, 1.0);
  renderer->AddActor(actor);
  renderer->GetActiveCamera()->ParallelProjectionOn();
  renderer->GetActiveCamera()->SetParallelScale(1.0);
  renderer->GetActiveCamera()->SetPosition(0.0, 0.0, 5.0);
  window.AddRenderer(renderer);
}

std::array<int, 3> pixel(const Picture& picture, int column, int row) {
  const unsigned char* p = picture.rgb.data() + 3 * (row * picture.size.width + column);
  return {p[0], p[1], p[2]};
}

TEST(Offscreen, DrawsWithoutADisplayTheTopRowFirst) {
  auto window = make_offscreen_window({160, 120}, OffscreenWay::surfaceless);
  if (!window) GTEST_SKIP() << window.error().text();
  fill(**window);
  const Picture picture = take_picture(**window);
  EXPECT_EQ(picture.size, (PictureSize{160, 120}));
  ASSERT_EQ(picture.rgb.size(), 3u * 160 * 120);
  // The ball's centre is half a half-height above the middle: row 60 - 30.
  EXPECT_EQ(pixel(picture, 80, 30), (std::array{255, 128, 0}));
  EXPECT_EQ(pixel(picture, 80, 90), (std::array{0, 0, 255}));
}

TEST(Offscreen, SmoothsEdges) {
  auto window = make_offscreen_window({160, 120}, OffscreenWay::surfaceless);
  if (!window) GTEST_SKIP() << window.error().text();
  fill(**window);
  const Picture picture = take_picture(**window);
  int between = 0;
  for (std::size_t i = 0; i < picture.rgb.size(); i += 3) {
    between += picture.rgb[i] > 0 && picture.rgb[i] < 255;
  }
  EXPECT_GT(between, 20);  // the outline is over a hundred pixels long
}

TEST(Offscreen, TheSamePictureTwiceAndFromAnotherWindow) {
  auto first = make_offscreen_window({320, 200}, OffscreenWay::surfaceless);
  if (!first) GTEST_SKIP() << first.error().text();
  auto second = make_offscreen_window({320, 200}, OffscreenWay::surfaceless);
  ASSERT_TRUE(second);
  fill(**first);
  fill(**second);
  const Picture picture = take_picture(**first);
  EXPECT_EQ(take_picture(**first), picture);
  EXPECT_EQ(take_picture(**second), picture);
  EXPECT_EQ(take_picture(**first), picture);  // after the other's context was current
}

// As in a window of X: of two flat things at one depth the later one is seen.
TEST(Offscreen, WhatComesLaterLiesOnTop) {
  auto window = make_offscreen_window({100, 100}, OffscreenWay::surfaceless);
  if (!window) GTEST_SKIP() << window.error().text();
  vtkNew<vtkRenderer> renderer;
  (*window)->AddRenderer(renderer);
  for (const double red : {0.0, 1.0}) {
    vtkNew<vtkPlaneSource> source;
    source->SetOrigin(10.0, 10.0, 0.0);
    source->SetPoint1(90.0, 10.0, 0.0);
    source->SetPoint2(10.0, 90.0, 0.0);
    vtkNew<vtkPolyDataMapper2D> mapper;
    mapper->SetInputConnection(source->GetOutputPort());
    vtkNew<vtkActor2D> actor;
    actor->SetMapper(mapper);
    actor->GetProperty()->SetColor(red, 0.0, 1.0 - red);
    renderer->AddActor2D(actor);
  }
  EXPECT_EQ(pixel(take_picture(**window), 50, 50), (std::array{255, 0, 0}));
}

TEST(Offscreen, WindowsComeAndGo) {
  for (int i = 0; i < 5; ++i) {
    auto window = make_offscreen_window({32 + i, 32}, OffscreenWay::surfaceless);
    if (!window) GTEST_SKIP() << window.error().text();
    fill(**window);
    EXPECT_EQ(take_picture(**window).size.width, 32 + i);
  }
}

TEST(Offscreen, SaysSoWhereTheDisplayDoesNotAnswer) {
  ::setenv("DISPLAY", ":54321", 1);
  const auto window = make_offscreen_window({32, 32}, OffscreenWay::x_display);
  ASSERT_FALSE(window);
  EXPECT_EQ(window.error().code, ErrorCode::unsupported);
  EXPECT_EQ(window.error().what, "the display :54321 does not answer");
  ::unsetenv("DISPLAY");
  EXPECT_EQ(make_offscreen_window({32, 32}, OffscreenWay::x_display).error().what,
            "there is no display: DISPLAY is not set");
}

}  // namespace
}  // namespace shoal::viz
