#include <algorithm>
#include <cmath>
#include <cstdio>
#include <glm/mat3x3.hpp>
#include <numbers>
#include <string>
#include <vector>

#include "scenes/actors.h"
#include "scenes/axes.h"
#include "scenes/legends.h"
#include "scenes/lobe.h"
#include "scenes/pictures.h"
#include "scenes/scene_parts.h"

namespace shoal::viz {
namespace {

std::string direction_text(const glm::vec3& direction) {
  char text[64];
  std::snprintf(text, sizeof text, "(%.2f, %.2f, %.2f)", direction.x, direction.y, direction.z);
  std::string typeset;
  for (const char* c = text; *c != '\0'; ++c)
    typeset += *c == '-' ? std::string(kMinus) : std::string(1, *c);
  return typeset;
}

std::vector<FigureRow> figures_of(const SceneInput& input, const Lobe& lobe) {
  const SceneSettings& settings = input.settings;
  std::vector<FigureRow> rows = {
      {describe(settings.quantity), {}},
      {"channel", std::string(name_of(settings.channel))},
      {"degree", std::to_string(lobe.degree)},
      {"mean", text_of(lobe.mean)},
      {"largest", text_of(lobe.largest)},
      {"towards", direction_text(lobe.largest_direction)},
      {"smallest", text_of(lobe.smallest)},
      {"scale", {}},
      {"radius", "|f(direction)|"},
      {"grid sphere", "|f| = " + text_of(lobe.unit)},
  };
  return rows;
}

// The panorama itself, if its pixels are there, and where in it the lobe is farthest out.
void add_thumbnail(const SceneInput& input, const Lobe& lobe, Stage& stage,
                   const Rectangle& column) {
  const Pixels& pixels = input.pixels->get(input.current, 512);
  if (pixels.empty()) return;
  const double height = 0.5 * column.width() * stage.width() / stage.height();
  const Rectangle place{column.left, column.bottom, column.right, column.bottom + height};
  const double exposure =
      automatic_exposure(radiance_of(current_panorama(input)), input.settings.exposure_stops);
  stage.add_picture(place, tone_mapped_picture(pixels, exposure));
  const glm::dvec3 d =
      glm::transpose(native_to_frame(input.settings.frame)) * glm::dvec3(lobe.largest_direction);
  const double turn = std::atan2(d.y, d.x) / (2.0 * std::numbers::pi);
  const double x = place.left + place.width() * (turn - std::floor(turn));
  const double y =
      place.top - place.height() * std::acos(std::clamp(d.z, -1.0, 1.0)) / std::numbers::pi;
  const double side = 0.016;
  const double across = side * stage.height() / stage.width();
  stage.add_outline({x - across, y - side, x + across, y + side}, theme::kAccent);
  stage.add_text(place.left, place.top + 0.3 * stage.line_height(TextSize::small),
                 "the panorama; square: largest f",
                 {.size = TextSize::small, .colour = theme::kDimText});
}

}  // namespace

Status show_lobes_scene(const SceneInput& input, Stage& stage) {
  const SceneSettings& settings = input.settings;
  const Panorama& panorama = current_panorama(input);
  const Lobe lobe = make_lobe(panorama, settings, kFineRings);
  stage.set_title(title_of(panorama), describe(settings.quantity) + " lobes");
  stage.set_caption(describe(settings.frame));

  const Rectangle body = stage.body();
  const double column = 0.25;
  const Rectangle side{body.right - column, body.bottom, body.right, body.top - 0.02};
  vtkRenderer& view = stage.add_view({body.left, body.bottom, side.left - 0.02, body.top});
  add_scale_sphere(view, settings.frame);
  add_axes(stage, view, 1.15);
  add_mesh(view, lobe.mesh, lobe.colours, Shading::lit);
  aim_camera(view, settings.frame, 1.21);

  const double below = add_figures(stage, side, figures_of(input, lobe));
  const double step = 1.15 * stage.line_height(TextSize::label);
  if (settings.colour == LobeColour::sign) {
    const LegendEntry entries[] = {{theme::kPositive, "f > 0"}, {theme::kNegative, "f < 0"}};
    add_legend(stage, side.right, below - 1.5 * step, entries);
  } else {
    stage.add_text(side.left, below - 1.5 * step, "colour: the light's own, at full brightness",
                   {.colour = theme::kDimText, .max_width = side.width()});
  }
  add_thumbnail(input, lobe, stage, side);
  return {};
}

}  // namespace shoal::viz
