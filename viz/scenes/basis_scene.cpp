#include <cmath>
#include <cstdlib>
#include <glm/geometric.hpp>
#include <numbers>
#include <string>
#include <vector>

#include "scenes/actors.h"
#include "scenes/axes.h"
#include "scenes/legends.h"
#include "scenes/scene_parts.h"
#include "scenes/shared_camera.h"
#include "sphere/basis.h"

namespace shoal::viz {
namespace {

constexpr int kDefaultDegree = 4;  // nine by five cells, the shape of a wide window

// The camera's radius for lobes that reach 1 along the vertical, which it sees foreshortened.
constexpr double kClose = 0.97;

// Every Y_lm at the sphere's vertices: values[vertex][coefficient_index(l, m)].
std::vector<std::vector<double>> sample_basis(const Mesh& sphere, int degree) {
  const Basis<double> basis(degree);
  std::vector<std::vector<double>> samples;
  for (const glm::vec3& position : sphere.positions) {
    samples.emplace_back(coefficient_count(degree));
    basis.evaluate(glm::normalize(glm::dvec3(position)), samples.back());
  }
  return samples;
}

// Where l stands in the pyramid's rows and m in its columns, less the place of the label.
struct Pyramid {
  Rectangle area;
  int degree;
  double label_height;

  [[nodiscard]] Rectangle cell(int l, int m) const {
    return grid_cell(area, 2 * degree + 1, degree + 1, m + degree, l);
  }
  [[nodiscard]] Rectangle view(int l, int m) const {
    Rectangle place = cell(l, m);
    place.bottom += label_height;
    return place;
  }
};

void add_orientation(const SceneInput& input, Stage& stage, const Pyramid& pyramid) {
  // The corner beside the pyramid's top is free from degree 1 on.
  const Rectangle first = pyramid.cell(0, -pyramid.degree);
  const Rectangle last = pyramid.cell((pyramid.degree - 1) / 2, -(pyramid.degree + 2) / 2);
  vtkRenderer& view = stage.add_view({first.left, last.bottom, last.right, first.top});
  add_axes(stage, view, 1.0, TextSize::small);
  aim_camera(view, input.settings.frame, 1.25);
}

}  // namespace

Status show_basis_scene(const SceneInput& input, Stage& stage) {
  const int degree = input.settings.degree.value_or(kDefaultDegree);
  stage.set_title("Real spherical harmonics",
                  "Y of degree l \u2264 " + std::to_string(degree) + " and order m = \u2212l to l");
  const LegendEntry entries[] = {{theme::kPositive, "Y > 0"}, {theme::kNegative, "Y < 0"}};
  set_caption(stage, "radius |Y|, one scale for all; below each: l, m", entries);

  const TextSize size = degree <= 6 ? TextSize::label : TextSize::small;
  const Pyramid pyramid{stage.body(), degree, stage.line_height(size)};
  const Mesh sphere = sphere_mesh(degree <= 4 ? 48 : 32);
  const auto samples = sample_basis(sphere, degree);
  // |Y_lm| <= sqrt((2l+1)/(4 pi)), which the zonal one reaches at its pole (addition theorem).
  const double largest = std::sqrt((2.0 * degree + 1.0) / (4.0 * std::numbers::pi));
  std::vector<double> values(samples.size());
  SharedCamera camera;  // one for all, so that all turn together
  for (int l = 0; l <= degree; ++l) {
    for (int m = -l; m <= l; ++m) {
      for (std::size_t i = 0; i < values.size(); ++i)
        values[i] = samples[i][coefficient_index(l, m)];
      const Mesh lobe = lobe_mesh(sphere, values, 1.0 / largest);
      vtkRenderer& view = stage.add_view(pyramid.view(l, m));
      add_mesh(view, lobe, sign_colours(lobe), Shading::lit);
      camera.look(view, input.settings.frame, kClose);
      const Rectangle cell = pyramid.cell(l, m);
      stage.add_text(cell.center_x(), cell.bottom,
                     std::to_string(l) + ", " + (m < 0 ? kMinus : "") + std::to_string(std::abs(m)),
                     {.size = size, .align = TextAlign::center, .max_width = cell.width()});
    }
  }
  if (degree > 0) add_orientation(input, stage, pyramid);
  return {};
}

}  // namespace shoal::viz
