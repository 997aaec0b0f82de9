#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <memory>
#include <numbers>
#include <string>
#include <vector>

#include "library/changed_pixels.h"
#include "library/light.h"
#include "library/viewpoint.h"
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
constexpr double kNameDistance = 1.1 * kAxisLength;  // of the axes' names

struct Ball {
  std::string title;
  std::string subtitle;
  Pixels light;
};

// What all three share.
struct Look {
  Frame frame;
  double exposure = 1.0;
  glm::vec3 dominant{0.0f};  // in the frame; zero where no direction is
};

// Where the light mostly comes from, in the frame.
glm::vec3 dominant_direction(const Coefficients& radiance, const Frame& frame) {
  const auto found = dominant_light(radiance);
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
  const auto ball = std::make_shared<const Mesh>(sphere_mesh(24));
  for (int axis = 0; axis < 3; ++axis) {
    for (const int sign : {1, -1}) {
      const glm::vec3 out(direction_of({axis, sign}));
      const glm::vec3 piece[] = {out, static_cast<float>(kAxisLength) * out};
      if (sign > 0) add_arrow(view, piece[0], piece[1], theme::kAxis, 0.012);
      if (sign < 0) add_lines(view, piece, theme::kAxis, 2.0);
      const std::string name = (sign > 0 ? "+" : kMinus) + std::string(1, "xyz"[axis]);
      add_label(stage, view, static_cast<float>(kNameDistance) * out, name, TextSize::small,
                theme::kText, ball);
    }
  }
}

bool lies_behind(const glm::vec3& direction, const Frame& frame) {
  return glm::dot(direction, glm::vec3(viewer_direction(frame))) < 0.0f;
}

// Towards the viewer it is a dot in a ring. Behind the ball it is seen through it, as its ghost.
void add_dominant_arrow(Stage& stage, vtkRenderer& view, const Look& look) {
  const glm::vec3& direction = look.dominant;
  constexpr int kPieces = 48;
  constexpr float kRise = 0.987f;  // of the ring's middle; its radius is an eighth of the ball's
  constexpr float kRadius = 0.16f;
  constexpr double kGhost = 0.4;  // opacity
  add_arrow(view, direction, 1.32f * direction, theme::kAccent, 0.03);
  if (lies_behind(direction, look.frame)) {
    add_arrow(stage.front_of(view), direction, 1.32f * direction, theme::kAccent, 0.03, kGhost);
  }
  const glm::vec3 some =
      std::abs(direction.z) < 0.9f ? glm::vec3(0.0f, 0.0f, 1.0f) : glm::vec3(1.0f, 0.0f, 0.0f);
  const glm::vec3 across = glm::normalize(glm::cross(direction, some));
  const glm::vec3 other = glm::cross(direction, across);
  const auto point = [&](int i) {
    const float angle = 2.0f * std::numbers::pi_v<float> * static_cast<float>(i) / kPieces;
    return 1.01f *
           (kRise * direction + kRadius * (std::cos(angle) * across + std::sin(angle) * other));
  };
  std::vector<glm::vec3> ring;
  for (int i = 0; i < kPieces; ++i) ring.insert(ring.end(), {point(i), point(i + 1)});
  add_lines(view, ring, theme::kAccent, 2.0);
  add_lines(stage.front_of(view), ring, theme::kAccent, 1.0);
}

// Of all that a view shows: the axes with their names, which take more of a small one.
double scene_radius(const Stage& stage, const Rectangle& view) {
  constexpr double kLeast = 1.36;
  const double side = std::min(view.width() * stage.width(), view.height() * stage.height());
  const double names = 1.1 * stage.text_pixels(TextSize::small) / side;
  return std::max(kLeast, 0.97 * kNameDistance / std::max(0.3, 1.0 - names));
}

// Ball and flat picture: the picture below, or beside it where the area is wide.
struct BallPlaces {
  Rectangle round;
  Rectangle flat;
};

BallPlaces lay_out_ball(const Stage& stage, const Rectangle& area) {
  const double line = stage.line_height(TextSize::label);
  if (stage.aspect(area) > 1.6) {
    const double middle = area.left + 0.42 * area.width();
    return {{area.left, area.bottom, middle, area.top},
            stage.fit({middle, area.bottom, area.right - 0.01, area.top}, 2.0)};
  }
  const Rectangle flat = stage.fit(
      {area.left, area.bottom + 0.3 * line, area.right, area.bottom + 0.35 * area.height()}, 2.0);
  return {{area.left, flat.top + 0.4 * line, area.right, area.top}, flat};
}

// The ball, the same as a flat picture, and its name.
void add_ball_view(const Ball& ball, const Look& look, SharedCamera& camera, Stage& stage,
                   const Rectangle& area) {
  const double line = stage.line_height(TextSize::label);
  stage.add_text(area.center_x(), area.top - line, ball.title,
                 {.size = TextSize::heading, .align = TextAlign::center});
  stage.add_text(
      area.center_x(), area.top - 2.1 * line,
      stage.clauses_within(ball.subtitle, TextSize::label, area.width()),
      {.colour = theme::kDimText, .align = TextAlign::center, .max_width = area.width()});
  const BallPlaces places =
      lay_out_ball(stage, {area.left, area.bottom, area.right, area.top - 2.5 * line});
  const Picture picture = tone_mapped_picture(ball.light, look.exposure);
  stage.add_picture(places.flat, picture);
  mark(look, stage, places.flat);
  vtkRenderer& view = stage.add_view(places.round);
  camera.look(view, look.frame, scene_radius(stage, places.round));
  add_ball(view, picture, look.frame);
  add_ball_axes(stage, view);
  if (look.dominant != glm::vec3(0.0f)) add_dominant_arrow(stage, view, look);
}

// For the caption.
std::string place_of_arrow(const Look& look) {
  if (look.dominant == glm::vec3(0.0f)) return "; it has no such direction";
  return lies_behind(look.dominant, look.frame)
             ? "; it lies behind the balls, and shows through them"
             : "";
}

}  // namespace

Status show_sphere_scene(const SceneInput& input, Stage& stage) {
  const SceneSettings& settings = input.settings;
  const Panorama& panorama = current_panorama(input);
  const Coefficients whole = radiance_of(panorama);
  const Coefficients radiance = truncate(whole, settings.degree.value_or(whole.degree));
  const Look look{settings.frame, automatic_exposure(whole, settings.exposure_stops),
                  dominant_direction(whole, settings.frame)};
  const Pixels& pixels = input.pixels->get(input.current, kTextureWidth);
  const std::string degree = "degree " + std::to_string(radiance.degree);
  const auto synthesised = [](const Coefficients& light) {
    return synthesise(light, kSmoothWidth, kSmoothWidth / 2);
  };
  std::vector<Ball> balls;
  if (!pixels.empty()) balls.push_back({"panorama", describe_pixels(panorama), pixels});
  balls.push_back({"reconstruction", "its radiance to " + degree + "; below zero is black",
                   synthesised(radiance)});
  balls.push_back({"irradiance / pi", "on a white matt ball, " + degree,
                   synthesised(apply_quantity(radiance, Quantity::irradiance_over_pi))});

  stage.set_title(title_of(panorama), "on the sphere");
  std::vector<std::string> lines = {
      "arrow in a ring (a dot in it: towards you) and square: where most light comes from, by "
      "degree 1 of luminance" +
          place_of_arrow(look),
      "one exposure, " + text_of(std::log2(look.exposure)) + " stops; " + describe(settings.frame)};
  if (pixels.empty()) {
    lines.push_back("no panorama beside them: " + input.pixels->why_empty(input.current));
  }
  stage.set_caption(lines);
  SharedCamera camera;  // one for all, so that they turn together
  const auto count = static_cast<int>(balls.size());
  for (int i = 0; i < count; ++i) {
    add_ball_view(balls[i], look, camera, stage,
                  part_of_row(stage.body(), stage.aspect(stage.body()), count, i));
  }
  return {};
}

}  // namespace shoal::viz
