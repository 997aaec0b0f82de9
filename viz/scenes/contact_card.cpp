#include "scenes/contact_card.h"

#include <algorithm>

namespace shoal::viz {
namespace {

// In pixels, from the card's upper left corner, y down; so that squares are squares.
struct Box {
  double x = 0.0;
  double y = 0.0;
  double width = 0.0;
  double height = 0.0;
};

struct Plan {
  Box thumbnail;
  Box ball;
  Box lobe;
  Box words;
  int lines = 2;

  [[nodiscard]] double picture_area() const {
    return thumbnail.width * thumbnail.height + ball.width * ball.height + lobe.width * lobe.height;
  }
};

// What lines of words take, and a little more between them and the pictures.
double words_height(int lines, double line) { return (lines + 0.2) * line; }

Plan in_columns(const Box& inner, double gap, double line) {
  Plan plan;
  const double side = std::min(0.5 * (inner.height - gap), 0.4 * inner.width);
  const double column = inner.width - side - gap;
  const double least = words_height(2, line);
  const double height = std::clamp(0.5 * column, 0.0, std::max(0.0, inner.height - least));
  plan.lines = inner.height - height >= words_height(3, line) ? 3 : 2;
  const double words = words_height(plan.lines, line);
  // What is left of the height goes around the thumbnail with its words, and around the balls.
  const double spare = 0.5 * (inner.height - height - words);
  plan.thumbnail = {inner.x, inner.y + std::max(0.0, spare), 2.0 * height, height};
  plan.words = {inner.x, plan.thumbnail.y + height + 0.2 * line, column, plan.lines * line};
  const double x = inner.x + inner.width - side;
  const double above = 0.5 * (inner.height - gap - 2.0 * side);
  plan.ball = {x, inner.y + above, side, side};
  plan.lobe = {x, inner.y + above + side + gap, side, side};
  return plan;
}

Plan in_a_row(const Box& inner, double gap, double line) {
  Plan plan;
  plan.lines = words_height(2, line) < 0.5 * inner.height ? 2 : 1;
  const double words = words_height(plan.lines, line);
  const double side =
      std::max(0.0, std::min(0.25 * (inner.width - 2.0 * gap), inner.height - words));
  const double y = inner.y + 0.5 * (inner.height - side - words);
  const double used = 4.0 * side + 2.0 * gap;
  const double x = inner.x + 0.5 * (inner.width - used);
  plan.thumbnail = {x, y, 2.0 * side, side};
  plan.ball = {x + 2.0 * side + gap, y, side, side};
  plan.lobe = {x + 3.0 * side + 2.0 * gap, y, side, side};
  const bool below_pictures = plan.lines > 1;  // else a name has all the width
  plan.words = {below_pictures ? x : inner.x, y + side + 0.2 * line,
                below_pictures ? used : inner.width, plan.lines * line};
  return plan;
}

}  // namespace

ContactCard lay_out_card(const Stage& stage, const Rectangle& cell) {
  const double width = stage.width();
  const double height = stage.height();
  const double line = stage.line_height(TextSize::small) * height;
  const double pad = 0.2 * line;
  const Box inner{pad, pad, cell.width() * width - 2.0 * pad, cell.height() * height - 2.0 * pad};
  const Plan columns = in_columns(inner, pad, line);
  const Plan row = in_a_row(inner, pad, line);
  const Plan& plan = columns.picture_area() > row.picture_area() ? columns : row;
  const auto placed = [&](const Box& box) {
    const double left = cell.left + box.x / width;
    const double top = cell.top - box.y / height;
    return Rectangle{left, top - box.height / height, left + box.width / width, top};
  };
  return {placed(plan.thumbnail), placed(plan.ball), placed(plan.lobe), placed(plan.words),
          plan.lines};
}

Grid roomiest_grid(const Stage& stage, const Rectangle& area, int count) {
  Grid best;
  double largest = -1.0;
  for (int columns = 1; columns <= count; ++columns) {
    const Grid grid{columns, (count + columns - 1) / columns};
    const ContactCard card = lay_out_card(stage, grid_cell(area, grid.columns, grid.rows, 0, 0));
    // Ball and lobe are of one size, so that of the thumbnail and theirs tells.
    const double size = card.thumbnail.width() * card.thumbnail.height() +
                        2.0 * card.ball.width() * card.ball.height();
    const bool fewer = grid.columns * grid.rows < best.columns * best.rows;
    if (size > largest * (1.0 + 1e-9) || (size > largest * (1.0 - 1e-9) && fewer)) {
      best = grid;
      largest = size;
    }
  }
  return best;
}

}  // namespace shoal::viz
