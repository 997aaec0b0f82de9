#include "app/viewer_pages.h"

#include <algorithm>
#include <cstddef>
#include <iterator>

#include "app/viewer_state.h"

namespace shoal::viz {
namespace {

constexpr double kLeading = 1.12;  // of lines of the card, in lines of type

}  // namespace

Stage show_help(vtkRenderWindow& window) {
  Stage sheet = Stage::over(window);
  double key_width = 0.0;
  double meaning_width = 0.0;
  for (const KeyHelp& help : kKeyHelp) {
    key_width = std::max(key_width, sheet.text_width(std::string(help.keys), TextSize::label));
    meaning_width =
        std::max(meaning_width, sheet.text_width(std::string(help.meaning), TextSize::label));
  }
  const double line = kLeading * sheet.line_height(TextSize::label);
  const double side = line * sheet.height() / sheet.width();  // as wide as a line is high
  const double half_width = std::min(0.49, 0.5 * (key_width + meaning_width) + 1.5 * side);
  const double half_height = 0.5 * line * static_cast<double>(std::size(kKeyHelp) + 2);
  const Rectangle card{0.5 - half_width, 0.5 - half_height, 0.5 + half_width, 0.5 + half_height};
  sheet.add_box(card, theme::kPanel);
  sheet.add_outline(card);
  double y = card.top - 1.5 * line;
  sheet.add_text(card.left + side, y, "Keys", {.size = TextSize::heading});
  for (const KeyHelp& help : kKeyHelp) {
    y -= line;
    const double meaning = card.left + 2.0 * side + key_width;
    sheet.add_text(card.left + side, y, std::string(help.keys), {.colour = theme::kAccent});
    sheet.add_text(meaning, y, std::string(help.meaning),
                   {.max_width = card.right - side - meaning});
  }
  return sheet;
}

Stage show_notice(const std::string& text, vtkRenderWindow& window) {
  constexpr double kWidest = 0.9;
  Stage sheet = Stage::over(window);
  const auto lines = sheet.wrapped(text, TextSize::label, kWidest);
  double width = 0.0;
  for (const std::string& words : lines) {
    width = std::max(width, std::min(kWidest, sheet.text_width(words, TextSize::label)));
  }
  const double line = kLeading * sheet.line_height(TextSize::label);
  const double side = line * sheet.height() / sheet.width();  // as wide as a line is high
  const double half_width = 0.5 * width + side;
  const double top = line * (static_cast<double>(lines.size()) + 1.2);
  const Rectangle card{0.5 - half_width, 0.5 * line, 0.5 + half_width, top};
  sheet.add_box(card, theme::kPanel);
  sheet.add_outline(card, theme::kAccent);
  double y = top - 0.1 * line;
  for (const std::string& words : lines) {
    y -= line;
    sheet.add_text(0.5, y, words,
                   {.align = TextAlign::center, .max_width = kWidest, .cut = TextCut::middle});
  }
  return sheet;
}

void show_failure(const std::string& title, const std::string& subject, const Error& error,
                  vtkRenderWindow& window) {
  Stage stage(window);
  stage.set_title(title, subject);
  const Rectangle body = stage.body();
  const double width = 0.7 * body.width();
  const double line = stage.line_height(TextSize::heading);
  double y = body.center_y() + 2.0 * line;
  stage.add_text(body.center_x(), y, "this scene cannot be shown",
                 {.size = TextSize::heading, .colour = theme::kAccent, .align = TextAlign::center});
  y -= 0.4 * line;
  for (const std::string& text : stage.wrapped(error.text(), TextSize::label, width)) {
    y -= line;
    stage.add_text(body.center_x(), y, text,
                   {.align = TextAlign::center, .max_width = body.width()});
  }
}

}  // namespace shoal::viz
