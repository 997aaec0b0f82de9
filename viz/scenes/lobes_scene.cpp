#include <algorithm>
#include <cmath>
#include <cstdio>
#include <glm/mat3x3.hpp>
#include <memory>
#include <string>
#include <vector>

#include "library/changed_pixels.h"
#include "library/light.h"
#include "scenes/actors.h"
#include "scenes/axes.h"
#include "scenes/legends.h"
#include "scenes/lobe.h"
#include "scenes/pictures.h"
#include "scenes/scene_parts.h"

namespace shoal::viz {
namespace {

// A hair beyond the unit sphere, which is a constant's lobe: lines within a surface look torn.
constexpr double kGridRadius = 1.005;

std::string direction_text(const glm::vec3& direction) {
  const auto rounded = [](float part) { return std::round(100.0 * part) / 100.0 + 0.0; };  // no -0
  char text[64];
  std::snprintf(text, sizeof text, "(%.2f, %.2f, %.2f)", rounded(direction.x), rounded(direction.y),
                rounded(direction.z));
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
      {"towards",
       lobe.largest_direction ? direction_text(*lobe.largest_direction) : "all directions"},
      {"smallest", text_of(lobe.smallest)},
      {"scale", {}},
      {"radius", "|f(direction)|"},
      {"unit sphere", "|f| = " + text_of(lobe.unit)},
  };
  return rows;
}

std::string wording(const Stage& stage, TextSize size, double width, const std::string& full,
                    const std::string& brief) {
  return stage.text_width(full, size) <= width ? full : brief;
}

// The panorama itself, if its pixels are there, and where in it the lobe is farthest out. At the
// bottom of the area, as large as there is room for.
void add_thumbnail(const SceneInput& input, const Lobe& lobe, Stage& stage, const Rectangle& area) {
  const Pixels& pixels = input.pixels->get(input.current, 512);
  const double line = stage.line_height(TextSize::small);
  const double whole = 0.5 * area.width() * stage.width() / stage.height();
  const double height = std::min(whole, area.height() - 1.3 * line);
  if (pixels.empty() || height < 2.0 * line) return;
  const Rectangle place{area.left, area.bottom, area.left + area.width() * height / whole,
                        area.bottom + height};
  const double exposure =
      automatic_exposure(radiance_of(current_panorama(input)), input.settings.exposure_stops);
  stage.add_picture(place, tone_mapped_picture(pixels, exposure));
  const glm::dmat3 to_native = glm::transpose(native_to_frame(input.settings.frame));
  const std::string what =
      lobe.largest_direction ? "the panorama; square: largest f" : "the panorama";
  const std::string brief = lobe.largest_direction ? "square: largest f" : what;
  if (lobe.largest_direction) {
    add_mark(stage, place, place_of(to_native * glm::dvec3(*lobe.largest_direction)), 0.016,
             theme::kAccent);
  }
  stage.add_text(place.left, place.top + 0.3 * line,
                 wording(stage, TextSize::small, area.width(), what, brief),
                 {.size = TextSize::small, .colour = theme::kDimText, .max_width = area.width()});
}

struct Places {
  Rectangle shape;
  Rectangle side;  // of the figures
};

// The figures at the right, or below where the window is high.
Places lay_out(const Stage& stage) {
  const Rectangle body = stage.body();
  if (stage.aspect(body) < 1.0) {
    const double split = body.bottom + 0.45 * body.height();
    return {{body.left, split, body.right, body.top},
            {body.left, body.bottom, body.right, split - 0.02}};
  }
  const Rectangle side{body.right - 0.25, body.bottom, body.right, body.top - 0.02};
  return {{body.left, body.bottom, side.left - 0.02, body.top}, side};
}

}  // namespace

Status show_lobes_scene(const SceneInput& input, Stage& stage) {
  const SceneSettings& settings = input.settings;
  const Panorama& panorama = current_panorama(input);
  const Lobe lobe = make_lobe(panorama, settings, kFineRings);
  stage.set_title(title_of(panorama), describe(settings.quantity) + " lobes");
  stage.set_caption(describe(settings.frame));

  const auto [shape, side] = lay_out(stage);
  vtkRenderer& view = stage.add_view(shape);
  add_scale_sphere(view, settings.frame, kGridRadius);
  add_axes(stage, view, 1.15, TextSize::label, std::make_shared<const Mesh>(lobe.mesh));
  add_mesh(view, lobe.mesh, lobe.colours, Shading::lit);
  aim_camera(view, settings.frame, 1.26);

  const double below = add_figures(stage, side, figures_of(input, lobe));
  const double legend = below - 1.725 * stage.line_height(TextSize::label);
  if (settings.colour == LobeColour::sign) {
    const LegendEntry entries[] = {{theme::kPositive, "f > 0"}, {theme::kNegative, "f < 0"}};
    add_legend(stage, side.right, legend, entries);
  } else {
    stage.add_text(
        side.left, legend,
        wording(stage, TextSize::label, side.width(), "colour: the light's own, at full brightness",
                "colour: the light's own"),
        {.colour = theme::kDimText, .max_width = side.width()});
  }
  const double free = legend - 0.5 * stage.line_height(TextSize::label);
  add_thumbnail(input, lobe, stage, {side.left, side.bottom, side.right, free});
  return {};
}

}  // namespace shoal::viz
