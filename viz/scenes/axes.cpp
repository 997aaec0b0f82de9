#include "scenes/axes.h"

#include <cmath>
#include <glm/vec3.hpp>
#include <numbers>
#include <string>
#include <vector>

#include "scenes/actors.h"
#include "scenes/legends.h"

namespace shoal::viz {
namespace {

constexpr char kNames[] = {'x', 'y', 'z'};

glm::vec3 along(int axis, double length) {
  glm::vec3 point(0.0f);
  point[axis] = static_cast<float>(length);
  return point;
}

// A circle of the sphere around axis `up`, as pairs of points: at height `rise` along it.
void add_parallel(std::vector<glm::vec3>& pairs, int up, double radius, double rise) {
  constexpr int kPieces = 96;
  const auto point = [&](int i) {
    const double angle = 2.0 * std::numbers::pi * i / kPieces;
    glm::vec3 p;
    p[up] = static_cast<float>(rise);
    p[(up + 1) % 3] = static_cast<float>(radius * std::cos(angle));
    p[(up + 2) % 3] = static_cast<float>(radius * std::sin(angle));
    return p;
  };
  for (int i = 0; i < kPieces; ++i) {
    pairs.push_back(point(i));
    pairs.push_back(point(i + 1));
  }
}

void add_meridian(std::vector<glm::vec3>& pairs, int up, double radius, double turn) {
  constexpr int kPieces = 48;
  const auto point = [&](int i) {
    const double polar = std::numbers::pi * i / kPieces;
    glm::vec3 p;
    p[up] = static_cast<float>(radius * std::cos(polar));
    p[(up + 1) % 3] = static_cast<float>(radius * std::sin(polar) * std::cos(turn));
    p[(up + 2) % 3] = static_cast<float>(radius * std::sin(polar) * std::sin(turn));
    return p;
  };
  for (int i = 0; i < kPieces; ++i) {
    pairs.push_back(point(i));
    pairs.push_back(point(i + 1));
  }
}

}  // namespace

void add_axes(Stage& stage, vtkRenderer& view, double length, TextSize size,
              const std::shared_ptr<const Mesh>& hidden_by) {
  // In small views type is large beside the axes.
  const double of_names = (size == TextSize::small ? 1.18 : 1.09) * length;
  for (int axis = 0; axis < 3; ++axis) {
    add_arrow(view, {}, along(axis, length), theme::kAxis, 0.009 * length);
    const glm::vec3 negative[] = {{}, along(axis, -length)};
    add_lines(view, negative, theme::kAxis, 1.0);
    add_label(stage, view, along(axis, of_names), std::string("+") + kNames[axis], size,
              theme::kText, hidden_by);
    add_label(stage, view, along(axis, -of_names), std::string(kMinus) + kNames[axis], size,
              theme::kDimText, hidden_by);
  }
}

void add_small_axes(vtkRenderer& view, double length) {
  for (int axis = 0; axis < 3; ++axis) {
    add_arrow(view, {}, along(axis, length), theme::kLine, 0.012 * length);
  }
}

void add_scale_sphere(vtkRenderer& view, const Frame& frame, double radius) {
  const int up = frame.up.axis;
  std::vector<glm::vec3> equator;
  add_parallel(equator, up, radius, 0.0);
  std::vector<glm::vec3> grid;
  for (const int degrees : {30, 60}) {
    const double polar = degrees * std::numbers::pi / 180.0;
    for (const double sign : {-1.0, 1.0}) {
      add_parallel(grid, up, radius * std::cos(polar), sign * radius * std::sin(polar));
    }
  }
  for (int i = 0; i < 12; ++i) add_meridian(grid, up, radius, i * std::numbers::pi / 6.0);
  add_lines(view, grid, theme::kLine, 1.0);
  add_lines(view, equator, theme::kAxis, 1.4);
}

std::string describe(const Frame& frame) {
  std::string names;
  for (const FrameAlias& alias : frame_aliases()) {
    if (alias.frame != frame) continue;
    names += (names.empty() ? " " : ", ") + std::string(alias.name);
  }
  const auto axis_text = [](const SignedAxis& axis) {
    return (axis.sign < 0 ? std::string(kMinus) : "+") + kNames[axis.axis];
  };
  return "frame" + names + ": centre " + axis_text(frame.center) + ", right " +
         axis_text(frame.right) + ", up " + axis_text(frame.up) +
         (mirrors(frame) ? "" : ", a mirror image of the scene");
}

}  // namespace shoal::viz
