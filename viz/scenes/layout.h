// Where things stand in the window, as fractions of it.
#pragma once

namespace shoal::viz {

// Fractions of the window, from its lower left corner.
struct Rectangle {
  double left = 0.0;
  double bottom = 0.0;
  double right = 1.0;
  double top = 1.0;

  [[nodiscard]] constexpr double width() const { return right - left; }
  [[nodiscard]] constexpr double height() const { return top - bottom; }
  [[nodiscard]] constexpr double center_x() const { return 0.5 * (left + right); }
  [[nodiscard]] constexpr double center_y() const { return 0.5 * (bottom + top); }
};

// Cell (column, row) of a grid of equal cells over the area, the top row first.
[[nodiscard]] constexpr Rectangle grid_cell(const Rectangle& area, int columns, int rows,
                                            int column, int row) {
  return {area.left + area.width() * column / columns, area.top - area.height() * (row + 1) / rows,
          area.left + area.width() * (column + 1) / columns, area.top - area.height() * row / rows};
}

// One of `count` equal parts of the area: side by side, or in an area higher than it is wide on the
// screen (`aspect` is its width over its height there) one above the other, the first on top.
[[nodiscard]] constexpr Rectangle part_of_row(const Rectangle& area, double aspect, int count,
                                              int part) {
  return aspect >= 1.0 ? grid_cell(area, count, 1, part, 0) : grid_cell(area, 1, count, 0, part);
}

// The rectangle made smaller by these fractions of the window on either side.
[[nodiscard]] constexpr Rectangle inset(const Rectangle& area, double horizontal, double vertical) {
  return {area.left + horizontal, area.bottom + vertical, area.right - horizontal,
          area.top - vertical};
}

}  // namespace shoal::viz
