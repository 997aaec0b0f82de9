#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <optional>
#include <string>
#include <vector>

#include "library/light.h"
#include "scenes/actors.h"
#include "scenes/axes.h"
#include "scenes/legends.h"
#include "scenes/scene_parts.h"
#include "scenes/shared_camera.h"
#include "sphere/linear_operations.h"

namespace shoal::viz {
namespace {

constexpr int kMostLobes = 11;
constexpr const char* kWidestLabel = "each its own scale";  // of those left of the lobes

// The sum over m of the channel's c_lm^2: what degree l has of the integral of f^2.
std::vector<double> energies_of(const Coefficients& coefficients, Channel channel) {
  std::vector<double> energies(coefficients.degree + 1, 0.0);
  for (int l = 0; l <= coefficients.degree; ++l) {
    for (int m = -l; m <= l; ++m) {
      const double c = channel_of(colour_at(coefficients, coefficient_index(l, m)), channel);
      energies[l] += c * c;
    }
  }
  return energies;
}

// Degrees 0 to `degree`, thinned evenly where they are more than `most`.
std::vector<int> shown_degrees(int degree, int most) {
  const int count = std::min(degree + 1, most);
  std::vector<int> degrees;
  for (int i = 0; i < count; ++i) {
    degrees.push_back(count == 1 ? degree : (2 * i * degree + count - 1) / (2 * (count - 1)));
  }
  return degrees;
}

constexpr int kDecades = 4;  // of energy: one scale for all panoramas, from all to 0.01 %

// What is there at all is not told as nothing.
std::string percent(double part) {
  if (part > 0.0 && part < 0.995 * std::pow(10.0, -kDecades)) return "< 0.01 %";
  char text[16];
  std::snprintf(text, sizeof text, part >= 0.0995 || part == 0.0 ? "%.0f %%" : "%.2g %%",
                100.0 * part);
  return text;
}

struct PartialSum {
  int degree;
  std::vector<double> values;  // at the sphere's vertices
  double largest;              // |value|; 1 where all are zero
};

// The value that is r = 1 where a lobe has a scale of its own: its largest one, unless it would
// then hold more than this radius' ball, which beside a thin lobe of reach 1 looks as large.
double own_unit(const Mesh& sphere, const PartialSum& sum) {
  constexpr double kMostRadius = 0.6;
  const double volume = signed_volume(lobe_mesh(sphere, sum.values, 1.0 / sum.largest));
  const double radius = std::cbrt(0.75 * std::numbers::inv_pi * volume);
  return sum.largest * std::max(1.0, radius / kMostRadius);
}

std::vector<PartialSum> partial_sums(const Mesh& sphere, const Coefficients& whole, Channel channel,
                                     int most) {
  std::vector<PartialSum> sums;
  for (const int degree : shown_degrees(whole.degree, most)) {
    sums.push_back({degree, channel_of(sample_on(sphere, truncate(whole, degree)), channel), 0.0});
    for (const double value : sums.back().values) {
      sums.back().largest = std::max(sums.back().largest, std::abs(value));
    }
    if (sums.back().largest == 0.0) sums.back().largest = 1.0;
  }
  return sums;
}

// A row of lobes under one camera; r = 1 is `unit`, or each one's own.
void add_lobe_row(const std::vector<PartialSum>& sums, const Mesh& sphere, const Frame& frame,
                  std::optional<double> unit, Stage& stage, const Rectangle& area) {
  SharedCamera camera;
  for (std::size_t i = 0; i < sums.size(); ++i) {
    const auto count = static_cast<int>(sums.size());
    vtkRenderer& view = stage.add_view(grid_cell(area, count, 1, static_cast<int>(i), 0));
    const Mesh lobe =
        lobe_mesh(sphere, sums[i].values, 1.0 / (unit ? *unit : own_unit(sphere, sums[i])));
    add_small_axes(view, 0.97);  // its tip within a lobe that reaches 1 along it
    add_mesh(view, lobe, sign_colours(lobe), Shading::lit);
    camera.look(view, frame, 1.08);
  }
}

// As many as are not much smaller than their labels.
int lobes_within(const Stage& stage, const Rectangle& area) {
  const double least = 3.2 * stage.line_height(TextSize::label) * stage.height() / stage.width();
  return std::clamp(static_cast<int>(area.width() / least), 2, kMostLobes);
}

// Two rows of lobes: their shapes, and their sizes.
void add_partial_sums(const SceneInput& input, const Coefficients& whole, Stage& stage,
                      const Rectangle& area) {
  const Mesh sphere = sphere_mesh(32);
  const std::vector<PartialSum> sums =
      partial_sums(sphere, whole, input.settings.channel, lobes_within(stage, area));
  double largest = 0.0;
  for (const PartialSum& sum : sums) largest = std::max(largest, own_unit(sphere, sum));

  const double line = stage.line_height(TextSize::label);
  const double row = 0.5 * (area.height() - line);
  const Rectangle shapes{area.left, area.top - row, area.right, area.top};
  const Rectangle sizes{area.left, area.bottom + line, area.right, area.bottom + line + row};
  add_lobe_row(sums, sphere, input.settings.frame, std::nullopt, stage, shapes);
  add_lobe_row(sums, sphere, input.settings.frame, largest, stage, sizes);
  const TextStyle dim{.size = TextSize::small, .colour = theme::kDimText};
  const double margin = stage.body().left;
  stage.add_text(margin, shapes.center_y(), "shape,", dim);
  stage.add_text(margin, shapes.center_y() - line, kWidestLabel, dim);
  stage.add_text(margin, sizes.center_y(), "size,", dim);
  stage.add_text(margin, sizes.center_y() - line, "one scale", dim);
  for (std::size_t i = 0; i < sums.size(); ++i) {
    const Rectangle cell =
        grid_cell(area, static_cast<int>(sums.size()), 1, static_cast<int>(i), 0);
    stage.add_text(cell.center_x(), cell.bottom, "l \u2264 " + std::to_string(sums[i].degree),
                   {.align = TextAlign::center, .max_width = cell.width()});
  }
}

double height_on(const Rectangle& chart, double part) {
  if (part <= 0.0) return chart.bottom;
  return chart.bottom + chart.height() * std::max(0.0, 1.0 + std::log10(part) / kDecades);
}

// Every decade, or every other one where there is no room for all the words.
void add_energy_axis(Stage& stage, const Rectangle& chart) {
  const double line = stage.line_height(TextSize::small);
  const int step = chart.height() / kDecades >= line ? 1 : 2;
  for (int decade = 0; decade <= kDecades; decade += step) {
    const double part = std::pow(10.0, -decade);
    const double y = height_on(chart, part);
    stage.add_box({chart.left, y, chart.right, y + 1.0 / stage.height()}, theme::kLine);
    stage.add_text(chart.left - 0.006, y - 0.35 * line, percent(part),
                   {.size = TextSize::small, .colour = theme::kDimText, .align = TextAlign::right});
  }
}

// Bars of energy over a logarithmic axis.
void add_energy_bars(const std::vector<double>& energies, Stage& stage, const Rectangle& area) {
  const double total = std::accumulate(energies.begin(), energies.end(), 0.0);
  const double line = stage.line_height(TextSize::small);
  add_energy_axis(stage, area);
  const int count = static_cast<int>(energies.size());
  const int label_step = 1 + (count - 1) / 24;
  // All of them have their number, or none, which would look picked out.
  const double cell_width = area.width() / count;
  const bool has_numbers = total > 0.0 && std::ranges::all_of(energies, [&](double energy) {
                             const std::string text = percent(energy / total);
                             return 1.1 * stage.text_width(text, TextSize::small) <= cell_width;
                           });
  for (int l = 0; l < count; ++l) {
    const Rectangle cell = grid_cell(area, count, 1, l, 0);
    const double half = std::min(0.3 * cell.width(), 0.03);
    const double part = total > 0.0 ? energies[l] / total : 0.0;
    const double top = height_on(area, part);
    stage.add_box({cell.center_x() - half, area.bottom, cell.center_x() + half, top}, theme::kBar);
    const std::string text = percent(part);
    const double half_text = 0.55 * stage.text_width(text, TextSize::small);
    if (has_numbers) {
      stage.add_box({cell.center_x() - half_text, top + 0.1 * line, cell.center_x() + half_text,
                     top + 1.1 * line},
                    theme::kBackground);
      stage.add_text(cell.center_x(), top + 0.2 * line, text,
                     {.size = TextSize::small, .align = TextAlign::center});
    }
    if (l % label_step != 0) continue;
    stage.add_text(cell.center_x(), area.bottom - 1.2 * line, std::to_string(l),
                   {.size = TextSize::small, .align = TextAlign::center});
  }
}

}  // namespace

Status show_degrees_scene(const SceneInput& input, Stage& stage) {
  const SceneSettings& settings = input.settings;
  const Panorama& panorama = current_panorama(input);
  const Coefficients whole = shown_coefficients(panorama, settings);
  stage.set_title(title_of(panorama), describe(settings.quantity) + " built up degree by degree");
  const LegendEntry entries[] = {{theme::kPositive, "f > 0"}, {theme::kNegative, "f < 0"}};
  set_caption(stage,
              std::string(name_of(settings.channel)) +
                  ", lobes of the sum of all degrees up to l; " + describe(settings.frame),
              entries);

  Rectangle body = stage.body();
  // The rows' and the axis' labels.
  body.left += std::max(0.115, stage.text_width(kWidestLabel, TextSize::small) + 0.01);
  const double line = stage.line_height(TextSize::label);
  const double split = body.bottom + 0.42 * body.height();
  add_partial_sums(input, whole, stage, {body.left, split, body.right, body.top});
  const Rectangle chart{body.left, body.bottom + 2.6 * line, body.right, split - 3.2 * line};
  const std::vector<double> energies = energies_of(whole, settings.channel);
  const bool is_black = std::ranges::all_of(energies, [](double energy) { return energy == 0.0; });
  const std::string heading =
      is_black ? "no energy at any degree"
               : "energy of each degree, logarithmic scale; the integral of f squared, as parts of "
                 "all";
  stage.add_text(body.left, chart.top + 1.3 * line,
                 stage.clauses_within(heading, TextSize::label, body.width()),
                 {.max_width = body.width()});
  add_energy_bars(energies, stage, chart);
  stage.add_text(chart.center_x(), body.bottom, "degree l",
                 {.colour = theme::kDimText, .align = TextAlign::center});
  return {};
}

}  // namespace shoal::viz
