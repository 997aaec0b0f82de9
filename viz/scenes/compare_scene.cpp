#include <algorithm>
#include <cmath>
#include <cstdio>
#include <string>
#include <vector>

#include "library/light.h"
#include "scenes/difference.h"
#include "scenes/equirect.h"
#include "scenes/legends.h"
#include "scenes/pictures.h"
#include "scenes/scene_parts.h"
#include "sphere/linear_operations.h"

namespace shoal::viz {
namespace {

constexpr int kWidth = 512;

struct Side {
  std::string title;
  Pixels light;
};

// What is compared, and at which exposure.
struct Pair {
  Side left;
  Side right;
  double exposure = 1.0;
  std::string subject;
  std::string left_noun;  // whose RMS the difference's is told in
};

// Pixels hold what was before a variant changed it; so two are compared by their coefficients.
Side side_of(const SceneInput& input, std::size_t index) {
  const Panorama& panorama = input.library->panoramas[index];
  const SceneSettings& settings = input.settings;
  Coefficients light = apply_quantity(radiance_of(panorama), settings.quantity);
  if (settings.degree) light = truncate(std::move(light), *settings.degree);
  return {title_of(panorama) + ", degree " + std::to_string(light.degree),
          synthesise(light, kWidth, kWidth / 2)};
}

Pair two_panoramas(const SceneInput& input, double exposure) {
  return {side_of(input, input.current), side_of(input, *input.other), exposure,
          describe(input.settings.quantity) + " compared", "the left's"};
}

// Error: usage, where there are no pixels.
Result<Pair> pixels_and_sum(const SceneInput& input, const Coefficients& whole, double exposure) {
  const Panorama& panorama = current_panorama(input);
  const Pixels& original = input.pixels->get(input.current, kWidth);
  if (original.empty()) {
    return Error{ErrorCode::usage,
                 "there are no pixels to compare with: " + input.pixels->why_empty(input.current),
                 title_of(panorama), "name a second panorama or variant: --with GLOB"};
  }
  const Coefficients shown = truncate(whole, input.settings.degree.value_or(whole.degree));
  // A small panorama's pixels come as they are, not made larger.
  return Pair{{"panorama: " + describe_pixels(panorama), original},
              {"reconstruction: radiance to degree " + std::to_string(shown.degree),
               synthesise(shown, original.width, original.height)},
              exposure,
              "original and reconstruction",
              "the original's"};
}

Result<Pair> pair_of(const SceneInput& input) {
  const Coefficients whole = radiance_of(current_panorama(input));
  const double exposure = automatic_exposure(whole, input.settings.exposure_stops);
  if (input.other) return two_panoramas(input, exposure);
  return pixels_and_sum(input, whole, exposure);
}

// Below a line for its title.
Rectangle place_of_picture(const Stage& stage, const Rectangle& cell) {
  const double line = stage.line_height(TextSize::label);
  return stage.fit({cell.left, cell.bottom, cell.right, cell.top - 1.3 * line}, 2.0);
}

Rectangle add_side(const std::string& title, const Picture& picture, Stage& stage,
                   const Rectangle& cell) {
  const Rectangle place = place_of_picture(stage, cell);
  stage.add_picture(place, picture);
  stage.add_outline(place);
  stage.add_text(place.left, place.top + 0.3 * stage.line_height(TextSize::label), title,
                 {.max_width = place.width()});
  return place;
}

// The texel's middle, as fractions of the picture.
glm::dvec2 middle_of(std::size_t texel, const Pixels& pixels) {
  return {(static_cast<double>(texel % pixels.width) + 0.5) / pixels.width,
          (static_cast<double>(texel / pixels.width) + 0.5) / pixels.height};
}

std::string place_text(std::size_t texel, const Pixels& pixels) {
  const glm::dvec2 middle = middle_of(texel, pixels);
  char text[64];
  std::snprintf(text, sizeof text, "%.0f°, %.0f°", 180.0 * middle.y, 360.0 * middle.x);
  return text;
}

// What the colours stand for, and the figures. Where there is no room for all, the bar's name goes,
// which is the picture's, and then the note below it.
void add_key(const Pair& pair, const Difference& difference, const std::string& channel,
             Stage& stage, const Rectangle& card) {
  const double line = stage.line_height(TextSize::label);
  stage.add_panel(card);
  const Rectangle inner = inset(card, 0.018, 0.02);
  const FigureRow rows[] = {
      {"RMS over the sphere", text_of(difference.rms)},
      {"of " + pair.left_noun + " RMS", percent_of(difference.relative_rms)},
      {"largest", text_of(difference.largest)},
      {"there (square): theta, phi", place_text(difference.largest_texel, pair.left.light)},
  };
  add_figures(stage, inner, rows);
  const double room = inner.height() - figures_height(stage, rows);
  const double name = 1.2 * stage.line_height(TextSize::small);
  const double bar = 1.9 * line;  // with its numbers
  const bool has_note = room >= bar + line;
  const bool has_name = room >= bar + line + name;
  const double bottom = inner.bottom + (has_note ? 2.0 : 1.0) * line;
  add_colour_bar(
      stage, {inner.left, bottom, inner.right, bottom + 0.9 * line},
      {-difference.scale, difference.scale, has_name ? "right minus left, " + channel : "",
       [](double fraction) { return diverging_colour(2.0 * fraction - 1.0); }});
  if (!has_note) return;
  stage.add_text(inner.left, inner.bottom - 0.1 * line,
                 percent_of(kBeyondScale) + " of the texels lie beyond the ends",
                 {.size = TextSize::small, .colour = theme::kDimText, .max_width = inner.width()});
}

}  // namespace

Status show_compare_scene(const SceneInput& input, Stage& stage) {
  SHOAL_ASSIGN_OR_RETURN(pair, pair_of(input));
  const std::string channel(name_of(input.settings.channel));
  const Difference difference =
      difference_of(pair.left.light, pair.right.light, input.settings.channel);
  stage.set_title(title_of(current_panorama(input)), pair.subject);
  stage.set_caption("difference of " + channel + ": RMS " + text_of(difference.rms) + " (" +
                    percent_of(difference.relative_rms) + " of " + pair.left_noun + "), largest " +
                    text_of(difference.largest) + "; one exposure, " +
                    text_of(std::log2(pair.exposure)) + " stops");
  const double gap = 0.01;
  const auto cell = [&](int column, int row) {
    return inset(grid_cell(stage.body(), 2, 2, column, row), gap * stage.height() / stage.width(),
                 gap);
  };
  add_side(pair.left.title, tone_mapped_picture(pair.left.light, pair.exposure), stage, cell(0, 0));
  add_side(pair.right.title, tone_mapped_picture(pair.right.light, pair.exposure), stage,
           cell(1, 0));
  const Rectangle below =
      add_side("right minus left, " + channel, difference_picture(difference, pair.left.light),
               stage, cell(0, 1));
  add_mark(stage, below, middle_of(difference.largest_texel, pair.left.light), 0.011,
           theme::kBackground);
  add_key(pair, difference, channel, stage, place_of_picture(stage, cell(1, 1)));
  return {};
}

}  // namespace shoal::viz
