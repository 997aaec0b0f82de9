// The window as a page: views, pictures and words on it, in shoal-viz's one look.
//
// Layers: a backdrop (panels), the views that the mouse turns, words in them, and an overlay
// (words, pictures, bars) that it does not. Flat things lie on one another in the order in which
// they are added, words on top of them all. Sizes are those of the window when the stage is made:
// after a window is resized its scene is shown again.
#pragma once

#include <vtkActor.h>
#include <vtkRenderWindow.h>
#include <vtkRenderer.h>
#include <vtkSmartPointer.h>

#include <glm/vec3.hpp>
#include <map>
#include <span>
#include <string>
#include <vector>

#include "scenes/colours.h"
#include "scenes/layout.h"
#include "scenes/type.h"
#include "window/picture.h"

namespace shoal::viz {

// Heights of type, in a window 720 pixels high: 26, 20, 16 and 14 pixels. They grow with it, or in
// one narrower than 4:3 with its width, and never fall below 11 pixels.
enum class TextSize { title, heading, label, small };

enum class TextAlign { left, center, right };

struct TextStyle {
  TextSize size = TextSize::label;
  glm::vec3 colour = theme::kText;
  TextAlign align = TextAlign::left;
  double max_width = 1.0;  // of the window; longer text is cut
  TextCut cut = TextCut::end;
};

class Stage {
 public:
  // Removes what the window shows.
  explicit Stage(vtkRenderWindow& window);

  // A sheet over what the window shows, for boxes and words alone; take_away() removes it.
  [[nodiscard]] static Stage over(vtkRenderWindow& window);
  void take_away();

  [[nodiscard]] vtkRenderWindow& window() { return window_; }
  [[nodiscard]] int width() const { return width_; }    // pixels
  [[nodiscard]] int height() const { return height_; }  // pixels
  // Width over height of a rectangle on the screen.
  [[nodiscard]] double aspect(const Rectangle& area) const;
  // The widest rectangle of that aspect in the middle of the area.
  [[nodiscard]] Rectangle fit(const Rectangle& area, double aspect) const;
  [[nodiscard]] int text_pixels(TextSize size) const;
  // The height of a line of type, as a fraction of the window's.
  [[nodiscard]] double line_height(TextSize size) const;
  // The width of a text, as a fraction of the window's.
  [[nodiscard]] double text_width(const std::string& text, TextSize size) const;

  // As many clauses of a text, parted by "; ", as have room; the first one in any case.
  [[nodiscard]] std::string clauses_within(const std::string& text, TextSize size,
                                           double width) const;

  // As many words a line as have room.
  [[nodiscard]] std::vector<std::string> wrapped(const std::string& text, TextSize size,
                                                 double width) const;

  // A title at the upper left, and what it is about, dimmer, to its right: that stays whole where
  // the title can be shortened to two thirds of the width for it.
  void set_title(const std::string& title, const std::string& subject = {});
  // Lines at the bottom, from the left; at most three of them are meant to be there. One that is
  // too long goes on in another, after a clause, or where a clause alone is too long, a word.
  void set_caption(std::span<const std::string> lines, double max_width = 1.0);
  void set_caption(const std::string& line, double max_width = 1.0) {
    set_caption(std::span(&line, 1), max_width);
  }
  // What title and caption (set before) leave free, with margins.
  [[nodiscard]] Rectangle body() const { return body_; }

  // A part of the window with a camera of its own, lit from over the viewer's left shoulder.
  vtkRenderer& add_view(const Rectangle& area);

  // What stands in a view's space in front of everything in the view, such as words at its points.
  // Made when it is first asked for; shares the camera that the view has then.
  vtkRenderer& front_of(vtkRenderer& view);

  // The baseline of the text's only line runs at y.
  void add_text(double x, double y, const std::string& text, const TextStyle& style = {});
  // A picture stretched over the area.
  void add_picture(const Rectangle& area, const Picture& picture);
  // A card behind views, pictures and words.
  void add_panel(const Rectangle& area, const glm::vec3& colour = theme::kPanel);
  // Of outlines, in pixels: 1 in a window 720 high.
  [[nodiscard]] double line_thickness() const;
  // A filled rectangle over views, and one's outline, a pixel thick in a window 720 high.
  void add_box(const Rectangle& area, const glm::vec3& colour);
  void add_outline(const Rectangle& area, const glm::vec3& colour = theme::kLine);

 private:
  Stage(vtkRenderWindow& window, int backdrop_layer, int overlay_layer);

  vtkActor& add_flat(vtkRenderer& layer, const Rectangle& pixels);
  void add_rectangle(vtkRenderer& layer, const Rectangle& area, const glm::vec3& colour);

  vtkRenderWindow& window_;
  int width_ = 0;
  int height_ = 0;
  int next_flat_ = 0;
  Rectangle body_;
  vtkSmartPointer<vtkRenderer> backdrop_;
  vtkSmartPointer<vtkRenderer> overlay_;
  std::map<vtkRenderer*, vtkRenderer*> fronts_;
};

}  // namespace shoal::viz
