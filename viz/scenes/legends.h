// What explains colours and numbers on the stage.
#pragma once

#include <functional>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <span>
#include <string>
#include <vector>

#include "scenes/stage.h"

namespace shoal::viz {

struct ColourBar {
  double low = 0.0;
  double high = 1.0;
  std::string label;                                      // what the numbers are
  std::function<glm::vec3(double fraction)> colour_of{};  // 0 at low, 1 at high
};

// The bar fills the area; its label stands a line above it, its ticks, its ends among
// them, a line below.
void add_colour_bar(Stage& stage, const Rectangle& area, const ColourBar& bar);

struct LegendEntry {
  glm::vec3 colour;
  std::string text;
};

// Coloured squares with words, in one line that ends at x = right. Returns where it begins.
double add_legend(Stage& stage, double right, double y, std::span<const LegendEntry> entries);

// The same at the right end of the stage's caption, which is shortened where both do not fit.
void set_caption(Stage& stage, const std::string& line, std::span<const LegendEntry> entries);

struct FigureRow {
  std::string name;  // at the left, dim; alone it is a heading
  std::string value;
};

// A column of figures, from the area's top. Returns the y below it.
double add_figures(Stage& stage, const Rectangle& area, std::span<const FigureRow> rows);

// How high that column is.
[[nodiscard]] double figures_height(const Stage& stage, std::span<const FigureRow> rows);

// A square around a place of a picture that fills the area, as fractions of its width and its
// height from its upper left corner; `half` its side, of the window's height. It stays inside.
// Lined with darkness, to be seen on what is bright.
void add_mark(Stage& stage, const Rectangle& area, const glm::dvec2& place, double half,
              const glm::vec3& colour);

// Round numbers of [low, high] that suit about `count` ticks, ascending: {0, "0"}, {0.25, "0.25"}.
struct Tick {
  double value = 0.0;
  std::string text;
};
[[nodiscard]] std::vector<Tick> ticks_between(double low, double high, int count);

// A minus as long as a plus, in UTF-8.
inline constexpr const char* kMinus = "\u2212";

// A number for people: three significant digits, no exponent between 0.0005 and 99999.
[[nodiscard]] std::string text_of(double value);

// 0.125 is "12.5 %".
[[nodiscard]] std::string percent_of(double share);

}  // namespace shoal::viz
