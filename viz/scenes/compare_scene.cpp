#include <algorithm>
#include <cmath>
#include <cstdio>
#include <glm/matrix.hpp>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "library/light.h"
#include "scenes/difference.h"
#include "scenes/equirect.h"
#include "scenes/legends.h"
#include "scenes/pictures.h"
#include "scenes/scene_parts.h"
#include "sphere/linear_operations.h"
#include "sphere/rotation.h"

namespace shoal::viz {
namespace {

constexpr int kWidth = 512;           // as it is shown
constexpr int kMeasuredWidth = 2048;  // at most, of pixels that are measured

struct Side {
  std::string title;
  Pixels light;
};

// What is compared, and at which exposure.
struct Pair {
  Side left;
  Side right;
  double exposure = 1.0;
  std::string note;  // behind the exposure in the caption
  std::string subject;
  std::string left_noun;  // whose RMS the difference's is told in
  // What is measured, where it has more texels than what is shown.
  std::optional<std::pair<Pixels, Pixels>> finer;
};

// The panorama's light as the settings want it shown.
Coefficients light_of(const SceneInput& input, std::size_t index) {
  const Coefficients light =
      apply_quantity(radiance_of(input.library->panoramas[index]), input.settings.quantity);
  return truncate(light, input.settings.degree.value_or(light.degree));
}

// Pixels may not be of that light, nor of that quantity; so two are compared by their coefficients.
Side side_of(const Panorama& panorama, const Coefficients& light) {
  return {title_of(panorama) + ", degree " + std::to_string(light.degree),
          synthesise(light, kWidth, kWidth / 2)};
}

// At the exposure that the brighter one has alone, so that neither is burnt out.
Pair two_panoramas(const SceneInput& input) {
  const Coefficients left = light_of(input, input.current);
  const Coefficients right = light_of(input, *input.other);
  const double stops = input.settings.exposure_stops;
  const double left_exposure = automatic_exposure(left, stops);
  const double right_exposure = automatic_exposure(right, stops);
  return {side_of(current_panorama(input), left),
          side_of(input.library->panoramas[*input.other], right),
          std::min(left_exposure, right_exposure),
          left_exposure <= right_exposure ? ", the left's" : ", the right's",
          describe(input.settings.quantity) + " compared",
          "the left's",
          {}};
}

// What is known of light without pixels is its coefficients; so fewer of them are compared with
// all.
Result<Pair> more_and_fewer(const SceneInput& input, const Coefficients& whole, double exposure) {
  const Panorama& panorama = current_panorama(input);
  const int degree = input.settings.degree.value_or(whole.degree);
  if (degree >= whole.degree) {
    const bool has_file = !panorama.file.empty();
    return Error{has_file ? ErrorCode::unreadable : ErrorCode::usage,
                 "there are no pixels to compare with: " + input.pixels->why_empty(input.current),
                 title_of(panorama),
                 "name a second panorama or variant, --with GLOB, or a --degree below " +
                     std::to_string(whole.degree)};
  }
  const auto side = [&](const std::string& what, const Coefficients& light) {
    return Side{what + ": radiance to degree " + std::to_string(light.degree),
                synthesise(light, kWidth, kWidth / 2)};
  };
  return Pair{side("all that is known", whole),
              side("reconstruction", truncate(whole, degree)),
              exposure,
              "",
              "more and fewer coefficients",
              "the left's",
              {}};
}

// Where figures are not those of every texel.
std::string note_of_size(const Panorama& panorama, const Pixels& measured) {
  if (are_its_texels(panorama, measured, kMeasuredWidth)) return "";
  return "; measured over " + std::to_string(measured.width) + " x " +
         std::to_string(measured.height) + " texels";
}

// Errors: usage, where there is nothing to compare with; unreadable, where its file is what fails.
// A light that is turned is compared as its pixels lie, turned back: pixels that were turned would
// not be its texels any more.
Result<Pair> pixels_and_sum(const SceneInput& input) {
  const Panorama& panorama = current_panorama(input);
  const Coefficients whole = radiance_of(panorama);
  const double exposure = automatic_exposure(whole, input.settings.exposure_stops);
  const Pixels& original = input.pixels->get(input.current, kWidth, Lying::as_in_file);
  if (original.empty()) return more_and_fewer(input, whole, exposure);
  const Coefficients shown = truncate(whole, input.settings.degree.value_or(whole.degree));
  const glm::dmat3 turn = panorama.change.turn;
  std::string note = turn == glm::dmat3(1.0) ? "" : "; both turned back, as the file lies";
  if (!panorama.change.is_whole) {
    note = "; the pixels are those before light was added or taken out, and so is their difference";
  }
  // A small panorama's pixels come as they are, not made larger.
  const Pixels& fine = input.pixels->get(input.current, kMeasuredWidth, Lying::as_in_file);
  const Coefficients lying = rotate(shown, glm::transpose(turn));
  const auto sum_like = [&](const Pixels& pixels) {
    return synthesise(lying, pixels.width, pixels.height);
  };
  Pair pair{
      {"panorama: " + describe_pixels(panorama), original},
      {"reconstruction: radiance to degree " + std::to_string(shown.degree), sum_like(original)},
      exposure,
      note_of_size(panorama, fine) + note,
      "original and reconstruction",
      "the original's",
      {}};
  if (fine.width > original.width) pair.finer = {fine, sum_like(fine)};
  return pair;
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
                 {.max_width = place.width(), .cut = TextCut::middle});
  return place;
}

// The texel's middle, as fractions of the picture.
glm::dvec2 middle_of(std::size_t texel, const Pixels& pixels) {
  return {(static_cast<double>(texel % pixels.width) + 0.5) / pixels.width,
          (static_cast<double>(texel / pixels.width) + 0.5) / pixels.height};
}

std::string place_text(const glm::dvec2& place) {
  char text[64];
  std::snprintf(text, sizeof text, "%.0f°, %.0f°", 180.0 * place.y, 360.0 * place.x);
  return text;
}

// The figures, and what there is to see of them.
struct Measured {
  Difference difference;
  glm::dvec2 largest_at{0.0};  // as fractions of the picture
  Picture picture;

  [[nodiscard]] double largest() const { return difference.values[difference.largest_texel]; }
};

Measured measure(const Pair& pair, Channel channel) {
  Difference shown = difference_of(pair.left.light, pair.right.light, channel);
  if (!pair.finer) {
    Picture picture = difference_picture(shown, pair.left.light);
    const glm::dvec2 at = middle_of(shown.largest_texel, pair.left.light);
    return {std::move(shown), at, std::move(picture)};
  }
  const auto& [left, right] = *pair.finer;
  Difference finer = difference_of(left, right, channel);
  shown.scale = finer.scale;
  const glm::dvec2 at = middle_of(finer.largest_texel, left);
  return {std::move(finer), at, difference_picture(shown, pair.left.light)};
}

// What the colours stand for, and the figures. Where there is no room for all, the bar's name goes,
// which is the picture's.
void add_key(const Pair& pair, const Measured& measured, const std::string& channel, Stage& stage,
             const Rectangle& card) {
  const Difference& difference = measured.difference;
  const double line = stage.line_height(TextSize::label);
  stage.add_panel(card);
  const Rectangle inner = inset(card, 0.018, 0.02);
  std::vector<FigureRow> rows = {
      {"RMS over the sphere", text_of(difference.rms)},
      {"of " + pair.left_noun + " RMS", percent_of(difference.relative_rms)},
      {"largest", text_of(measured.largest())},
  };
  if (difference.largest > 0.0) {
    rows.push_back({"there (square): theta, phi", place_text(measured.largest_at)});
  }
  add_figures(stage, inner, rows);
  const double room = inner.height() - figures_height(stage, rows);
  const double name = 1.2 * stage.line_height(TextSize::small);
  const double bar = 1.9 * line;  // with its numbers
  const bool has_name = room >= bar + name;
  const double bottom = inner.bottom + line;
  const double thick = std::clamp(room - 1.4 * line, 0.4 * line, 0.9 * line);
  add_colour_bar(
      stage, {inner.left, bottom, inner.right, bottom + thick},
      {-difference.scale, difference.scale, has_name ? "right minus left, " + channel : "",
       [](double fraction) { return diverging_colour(2.0 * fraction - 1.0); }});
}

// For the caption, as a clause of it.
std::string beyond_the_ends(const Difference& difference) {
  if (difference.beyond == 0.0) return "";
  return "; " + percent_of(difference.beyond) + " of the texels lie beyond the colours' ends";
}

}  // namespace

Status show_compare_scene(const SceneInput& input, Stage& stage) {
  const Result<Pair> found = input.other ? two_panoramas(input) : pixels_and_sum(input);
  if (!found) return found.error();
  const Pair& pair = *found;
  const std::string channel(name_of(input.settings.channel));
  const Measured measured = measure(pair, input.settings.channel);
  const Difference& difference = measured.difference;
  stage.set_title(title_of(current_panorama(input)), pair.subject);
  stage.set_caption("difference of " + channel + ": RMS " + text_of(difference.rms) + " (" +
                    percent_of(difference.relative_rms) + " of " + pair.left_noun + "), largest " +
                    text_of(measured.largest()) + beyond_the_ends(difference) + "; one exposure, " +
                    text_of(std::log2(pair.exposure)) + " stops" + pair.note);
  const double gap = 0.01;
  const double aspect = stage.aspect(stage.body());
  const int columns = aspect < 1.0 ? 1 : aspect > 3.5 ? 4 : 2;  // of four cells
  const auto cell = [&](int place) {
    return inset(grid_cell(stage.body(), columns, 4 / columns, place % columns, place / columns),
                 gap * stage.height() / stage.width(), gap);
  };
  add_side(pair.left.title, tone_mapped_picture(pair.left.light, pair.exposure), stage, cell(0));
  add_side(pair.right.title, tone_mapped_picture(pair.right.light, pair.exposure), stage, cell(1));
  const Rectangle below =
      add_side("right minus left, " + channel, measured.picture, stage, cell(2));
  if (difference.largest > 0.0) {
    add_mark(stage, below, measured.largest_at, 0.011, theme::kBackground);
  }
  // A high window's cells are low, and a picture's height would not do for the figures.
  const Rectangle key = columns == 1 ? cell(3) : place_of_picture(stage, cell(3));
  add_key(pair, measured, channel, stage, key);
  return {};
}

}  // namespace shoal::viz
