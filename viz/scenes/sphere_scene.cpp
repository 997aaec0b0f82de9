#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <string>

#include "library/light.h"
#include "scenes/actors.h"
#include "scenes/axes.h"
#include "scenes/equirect.h"
#include "scenes/legends.h"
#include "scenes/mesh.h"
#include "scenes/pictures.h"
#include "scenes/scene_parts.h"
#include "scenes/shared_camera.h"
#include "sphere/dominant_light.h"
#include "sphere/linear_operations.h"

namespace shoal::viz {
namespace {

constexpr int kTextureWidth = 1024;
constexpr int kSmoothWidth = 512;  // of sums of the basis: four texels a half wave of degree 64
constexpr double kAxisLength = 1.22;
constexpr double kSceneRadius = 1.36;  // of all that a view shows: the axes with their names

struct Ball {
  std::string title;
  std::string subtitle;
  Pixels light;  // empty: there is no file to take it from
};

// What all three share.
struct Look {
  Frame frame;
  double exposure = 1.0;
  glm::vec3 dominant{0.0f};  // in the frame; zero where no direction is
};

// Where the light mostly comes from, in the frame.
glm::vec3 dominant_direction(const Coefficients& radiance, const Frame& frame) {
  const auto found = dominant_light(radiance, radiance.degree);
  return found ? glm::vec3(native_to_frame(frame) * found->light.direction) : glm::vec3(0.0f);
}

// A square where the dominant direction lies in the flat picture.
void mark(const Look& look, Stage& stage, const Rectangle& flat) {
  const glm::dvec3 d = glm::transpose(native_to_frame(look.frame)) * glm::dvec3(look.dominant);
  if (glm::length(d) == 0.0) return;
  add_mark(stage, flat, place_of(d), 0.009, theme::kAccent);
}

// The frame's half axes from where they leave the ball. What is behind the ball it hides, names
// too.
void add_ball_axes(Stage& stage, vtkRenderer& view) {
  for (int axis = 0; axis < 3; ++axis) {
    for (const int sign : {1, -1}) {
      const glm::vec3 out(direction_of({axis, sign}));
      const glm::vec3 piece[] = {out, static_cast<float>(kAxisLength) * out};
      if (sign > 0) add_arrow(view, piece[0], piece[1], theme::kAxis, 0.012);
      if (sign < 0) add_lines(view, piece, theme::kAxis);
      const std::string name = (sign > 0 ? "+" : kMinus) + std::string(1, "xyz"[axis]);
      add_label(stage, view, 1.1f * piece[1], name, TextSize::small, theme::kText,
                LabelDepth::among);
    }
  }
}

// The ball, below it the same as a flat picture, and its name.
void add_ball_view(const Ball& ball, const Look& look, SharedCamera& camera, Stage& stage,
                   const Rectangle& area) {
  const double line = stage.line_height(TextSize::label);
  stage.add_text(area.center_x(), area.top - line, ball.title,
                 {.size = TextSize::heading, .align = TextAlign::center});
  stage.add_text(
      area.center_x(), area.top - 2.1 * line,
      stage.clauses_within(ball.subtitle, TextSize::label, area.width()),
      {.colour = theme::kDimText, .align = TextAlign::center, .max_width = area.width()});
  const Rectangle flat = stage.fit(
      {area.left, area.bottom + 0.3 * line, area.right, area.bottom + 0.31 * area.height()}, 2.0);
  const Rectangle round{area.left, flat.top + 0.4 * line, area.right, area.top - 2.5 * line};
  if (ball.light.empty()) {
    stage.add_outline(flat);
    stage.add_text(round.center_x(), round.center_y(), "no pixels to show",
                   {.colour = theme::kDimText, .align = TextAlign::center});
    return;
  }
  const Picture picture = tone_mapped_picture(ball.light, look.exposure);
  stage.add_picture(flat, picture);
  mark(look, stage, flat);
  vtkRenderer& view = stage.add_view(round);
  camera.look_at_lit_side(view, look.frame, kSceneRadius);
  add_ball(view, picture, look.frame);
  add_ball_axes(stage, view);
  if (look.dominant != glm::vec3(0.0f)) {
    add_arrow(view, look.dominant, 1.32f * look.dominant, theme::kAccent, 0.03);
  }
}

}  // namespace

Status show_sphere_scene(const SceneInput& input, Stage& stage) {
  const SceneSettings& settings = input.settings;
  const Panorama& panorama = current_panorama(input);
  const Coefficients whole = radiance_of(panorama);
  const Coefficients radiance = truncate(whole, settings.degree.value_or(whole.degree));
  const Look look{settings.frame, automatic_exposure(whole, settings.exposure_stops),
                  dominant_direction(whole, settings.frame)};
  const std::string degree = "degree " + std::to_string(radiance.degree);
  const auto synthesised = [](const Coefficients& light) {
    return synthesise(light, kSmoothWidth, kSmoothWidth / 2);
  };
  Ball balls[] = {
      {"panorama", describe_pixels(panorama), input.pixels->get(input.current, kTextureWidth)},
      {"reconstruction", "its radiance to " + degree + "; below zero is black",
       synthesised(radiance)},
      {"irradiance / pi", "on a white matt ball, " + degree,
       synthesised(apply_quantity(radiance, Quantity::irradiance_over_pi))}};
  if (balls[0].light.empty()) balls[0].subtitle = input.pixels->why_empty(input.current);

  stage.set_title(title_of(panorama), "on the sphere");
  const std::string lines[] = {
      "arrow and square: where the light mostly comes from, by degree 1 of its luminance",
      "one exposure, " + text_of(std::log2(look.exposure)) + " stops; " + describe(settings.frame)};
  stage.set_caption(lines);
  SharedCamera camera;  // one for all, so that they turn together
  for (int i = 0; i < 3; ++i) {
    add_ball_view(balls[i], look, camera, stage, grid_cell(stage.body(), 3, 1, i, 0));
  }
  return {};
}

}  // namespace shoal::viz
