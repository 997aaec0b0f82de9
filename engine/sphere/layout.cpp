#include "sphere/layout.h"

#include <algorithm>
#include <vector>

#include "core/diagnostic.h"

namespace shoal {
namespace {

// Columns and rows of a layout's picture, in units of its edge.
struct Shape {
  int columns;
  int rows;
  std::string_view aspect;
};

Shape shape_of(Layout layout) {
  switch (layout) {
    case Layout::automatic:
    case Layout::equirect:
      return {2, 1, "2:1"};
    case Layout::cube_vertical_cross:
      return {3, 4, "3:4"};
    case Layout::cube_horizontal_cross:
      return {4, 3, "4:3"};
    case Layout::cube_horizontal_strip:
      return {6, 1, "6:1"};
    case Layout::cube_vertical_strip:
    case Layout::cube_faces:
    case Layout::cube_openexr:
      return {1, 6, "1:6"};
    default:
      return {1, 1, "1:1"};
  }
}

}  // namespace

std::string_view name_of(Layout layout) {
  return std::ranges::find(kLayoutNames, layout, &LayoutName::layout)->name;
}

Result<Layout> parse_layout(std::string_view name) {
  const auto found = std::ranges::find(kLayoutNames, name, &LayoutName::name);
  if (found != kLayoutNames.end()) return found->layout;
  std::vector<std::string_view> names;
  std::string listed;
  for (const LayoutName& known : kLayoutNames) {
    names.push_back(known.name);
    listed += (listed.empty() ? "use one of " : ", ") + std::string(known.name);
  }
  const std::string_view near = closest_match(name, names);
  return Error{ErrorCode::usage, "unknown layout \"" + std::string(name) + "\"", "",
               near.empty() ? listed : "did you mean \"" + std::string(near) + "\"?"};
}

bool is_cube(Layout layout) {
  return layout >= Layout::cube_vertical_cross && layout <= Layout::cube_openexr;
}

Frame cube_frame() { return {{2, 1}, {0, 1}, {1, 1}}; }

std::optional<Layout> layout_of_aspect(int width, int height) {
  for (const Layout layout :
       {Layout::equirect, Layout::cube_vertical_cross, Layout::cube_horizontal_cross,
        Layout::cube_vertical_strip, Layout::cube_horizontal_strip, Layout::angular}) {
    const Shape shape = shape_of(layout);
    if (width % shape.columns == 0 && height % shape.rows == 0 &&
        width / shape.columns == height / shape.rows) {
      return layout;
    }
  }
  return std::nullopt;
}

LayoutSize size_of(Layout layout, int edge) {
  const Shape shape = shape_of(layout);
  return {shape.columns * edge, shape.rows * edge};
}

std::string_view aspect_of(Layout layout) { return shape_of(layout).aspect; }

}  // namespace shoal
