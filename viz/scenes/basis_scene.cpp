#include <algorithm>
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

// The highest one whose shapes are seen at one scale: beyond it most are specks beside the zonal
// one of the highest degree.
constexpr int kMostAtOneScale = 8;

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

double largest_of(const std::vector<double>& values) {
  double largest = 0.0;
  for (const double value : values) largest = std::max(largest, std::abs(value));
  return largest;
}

std::string order_text(int m) { return (m < 0 ? kMinus : "") + std::to_string(std::abs(m)); }

// Where l stands in the pyramid's rows and m in its columns.
struct Pyramid {
  Rectangle area;
  int degree;
  TextSize size;              // of the labels
  double label_height = 0.0;  // below each lobe; 0 where there is room along the edges only

  [[nodiscard]] Rectangle cell(int l, int m) const {
    return grid_cell(area, 2 * degree + 1, degree + 1, m + degree, l);
  }
  [[nodiscard]] Rectangle view(int l, int m) const {
    Rectangle place = cell(l, m);
    place.bottom += label_height;
    return place;
  }
};

// "l, m" below each lobe where that has room in a cell, else l at the left of the rows and m below
// the columns.
Pyramid lay_out(const Stage& stage, int degree) {
  Pyramid pyramid{stage.body(), degree, degree <= 6 ? TextSize::label : TextSize::small};
  const double line = stage.line_height(pyramid.size);
  const std::string widest = std::to_string(degree) + ", " + order_text(-degree) + " ";
  const Rectangle cell = pyramid.cell(degree, 0);
  if (stage.text_width(widest, pyramid.size) <= cell.width() && 3.0 * line <= cell.height()) {
    pyramid.label_height = line;
    return pyramid;
  }
  pyramid.area.left += stage.text_width("l = " + std::to_string(degree) + " ", pyramid.size);
  pyramid.area.bottom += 1.2 * line;
  return pyramid;
}

void add_label_below(Stage& stage, const Pyramid& pyramid, int l, int m) {
  const Rectangle cell = pyramid.cell(l, m);
  stage.add_text(cell.center_x(), cell.bottom, std::to_string(l) + ", " + order_text(m),
                 {.size = pyramid.size, .align = TextAlign::center, .max_width = cell.width()});
}

// As many as do not touch one another; those of 0 are there in any case.
void add_labels_along_edges(Stage& stage, const Pyramid& pyramid) {
  const auto step_for = [](double room, double needed) {
    return std::max(1, static_cast<int>(std::ceil(needed / room)));
  };
  const Rectangle cell = pyramid.cell(0, 0);
  const double line = stage.line_height(pyramid.size);
  const int row_step = step_for(cell.height(), line);
  for (int l = 0; l <= pyramid.degree; l += row_step) {
    stage.add_text(stage.body().left, pyramid.cell(l, 0).center_y() - 0.35 * line,
                   "l = " + std::to_string(l), {.size = pyramid.size});
  }
  const std::string widest = "m = " + order_text(-pyramid.degree) + "  ";
  const int step = step_for(cell.width(), stage.text_width(widest, pyramid.size));
  for (int m = -(pyramid.degree / step) * step; m <= pyramid.degree; m += step) {
    stage.add_text(pyramid.cell(0, m).center_x(), stage.body().bottom, "m = " + order_text(m),
                   {.size = pyramid.size, .align = TextAlign::center});
  }
}

void add_orientation(const SceneInput& input, Stage& stage, const Pyramid& pyramid) {
  // The corner beside the pyramid's top is free from degree 1 on.
  const Rectangle first = pyramid.cell(0, -pyramid.degree);
  const Rectangle last = pyramid.cell((pyramid.degree - 1) / 2, -(pyramid.degree + 2) / 2);
  vtkRenderer& view = stage.add_view({first.left, last.bottom, last.right, first.top});
  add_axes(stage, view, 1.0, TextSize::small);
  aim_camera(view, input.settings.frame, 1.32);
}

}  // namespace

Status show_basis_scene(const SceneInput& input, Stage& stage) {
  const int degree = input.settings.degree.value_or(kDefaultDegree);
  stage.set_title("Real spherical harmonics",
                  "Y of degree l \u2264 " + std::to_string(degree) + " and order m = \u2212l to l");
  const LegendEntry entries[] = {{theme::kPositive, "Y > 0"}, {theme::kNegative, "Y < 0"}};
  const bool has_one_scale = degree <= kMostAtOneScale;
  set_caption(stage,
              std::string("radius |Y|, ") +
                  (has_one_scale ? "one scale for all" : "each at a scale of its own") +
                  "; rows l, columns m",
              entries);

  const Pyramid pyramid = lay_out(stage, degree);
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
      const Mesh lobe =
          lobe_mesh(sphere, values, 1.0 / (has_one_scale ? largest : largest_of(values)));
      vtkRenderer& view = stage.add_view(pyramid.view(l, m));
      add_mesh(view, lobe, sign_colours(lobe), Shading::lit);
      camera.look(view, input.settings.frame, kClose);
      if (pyramid.label_height > 0.0) add_label_below(stage, pyramid, l, m);
    }
  }
  if (pyramid.label_height == 0.0) add_labels_along_edges(stage, pyramid);
  if (degree > 0) add_orientation(input, stage, pyramid);
  return {};
}

}  // namespace shoal::viz
