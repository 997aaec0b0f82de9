#include "scenes/legends.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace shoal::viz {
namespace {

constexpr double kGapOverHeading = 0.5;  // of a column of figures, in its lines

double place_on(const ColourBar& bar, const Rectangle& area, double value) {
  return std::lerp(area.left, area.right, (value - bar.low) / (bar.high - bar.low));
}

// A tick's line, and its words below it.
void add_tick(Stage& stage, const Rectangle& area, double x, const std::string& text,
              TextAlign align) {
  const double line = stage.line_height(TextSize::small);
  const double half = 0.5 / stage.width();
  stage.add_box({x - half, area.bottom - 0.2 * line, x + half, area.bottom}, theme::kDimText);
  stage.add_text(x, area.bottom - 1.15 * line, text,
                 {.size = TextSize::small, .colour = theme::kDimText, .align = align});
}

// Both ends, and the round numbers between whose words do not touch theirs.
void add_ticks(Stage& stage, const Rectangle& area, const ColourBar& bar) {
  const double em = stage.line_height(TextSize::small) * stage.height() / stage.width();
  const auto width = [&](const std::string& text) {
    return stage.text_width(text, TextSize::small);
  };
  const std::string low = text_of(bar.low);
  const std::string high = text_of(bar.high);
  add_tick(stage, area, area.left, low, TextAlign::left);
  add_tick(stage, area, area.right, high, TextAlign::right);
  const double end = std::max(width(low), width(high)) + em;
  const int count = static_cast<int>(area.width() / (5.0 * em)) + 1;
  for (const Tick& tick : ticks_between(bar.low, bar.high, std::clamp(count, 2, 7))) {
    const double x = place_on(bar, area, tick.value);
    // As wide as its negative, so that both are there or neither.
    const double half = 0.5 * std::max(width(tick.text), width(text_of(-tick.value)));
    if (x - half < area.left + end || x + half > area.right - end) continue;
    add_tick(stage, area, x, tick.text, TextAlign::center);
  }
}

double figure_line(const Stage& stage) { return 1.15 * stage.line_height(TextSize::label); }

}  // namespace

void add_colour_bar(Stage& stage, const Rectangle& area, const ColourBar& bar) {
  constexpr int kSteps = 256;
  Picture ramp{{kSteps, 1}, {}};
  for (int i = 0; i < kSteps; ++i) {
    const glm::vec3 colour = bar.colour_of(i / (kSteps - 1.0));
    for (int c = 0; c < 3; ++c) {
      ramp.rgb.push_back(static_cast<unsigned char>(std::lround(255.0f * colour[c])));
    }
  }
  stage.add_picture(area, ramp);
  const double line = stage.line_height(TextSize::small);
  stage.add_text(area.center_x(), area.top + 0.2 * line, bar.label,
                 {.size = TextSize::small, .align = TextAlign::center});
  add_ticks(stage, area, bar);
}

double add_legend(Stage& stage, double right, double y, std::span<const LegendEntry> entries) {
  const double side = 0.6 * stage.line_height(TextSize::label);
  const double side_width = side * stage.height() / stage.width();
  for (auto entry = entries.rbegin(); entry != entries.rend(); ++entry) {
    right -= stage.text_width(entry->text, TextSize::label);
    stage.add_text(right, y, entry->text, {});
    right -= 1.4 * side_width;
    stage.add_box({right, y + 0.25 * side, right + side_width, y + 1.25 * side}, entry->colour);
    right -= 1.6 * side_width;
  }
  return right;
}

void set_caption(Stage& stage, const std::string& line, std::span<const LegendEntry> entries) {
  const Rectangle body = stage.body();
  const double legend = add_legend(stage, body.right, body.bottom, entries);
  stage.set_caption(line, legend - body.left);
}

double add_figures(Stage& stage, const Rectangle& area, std::span<const FigureRow> rows) {
  const double line = figure_line(stage);
  double y = area.top;
  for (const FigureRow& row : rows) {
    if (row.value.empty()) {
      if (y < area.top) y -= kGapOverHeading * line;
      y -= line;
      stage.add_text(area.left, y, row.name, {.max_width = area.width()});
      continue;
    }
    y -= line;
    const double used = stage.text_width(row.name + "  ", TextSize::label);
    stage.add_text(area.left, y, row.name, {.colour = theme::kDimText, .max_width = area.width()});
    stage.add_text(area.right, y, row.value,
                   {.align = TextAlign::right, .max_width = area.width() - used});
  }
  return y;
}

double figures_height(const Stage& stage, std::span<const FigureRow> rows) {
  double lines = 0.0;
  for (const FigureRow& row : rows) {
    if (row.value.empty() && lines > 0.0) lines += kGapOverHeading;
    lines += 1.0;
  }
  return lines * figure_line(stage);
}

void add_mark(Stage& stage, const Rectangle& area, const glm::dvec2& place, double half,
              const glm::vec3& colour) {
  const double half_width = half * stage.height() / stage.width();
  const double x = std::clamp(area.left + area.width() * place.x, area.left + half_width,
                              area.right - half_width);
  const double y =
      std::clamp(area.top - area.height() * place.y, area.bottom + half, area.top - half);
  stage.add_outline({x - half_width, y - half, x + half_width, y + half}, colour);
  const double across = stage.line_thickness() / stage.width();
  const double along = stage.line_thickness() / stage.height();
  stage.add_outline(
      {x - half_width + across, y - half + along, x + half_width - across, y + half - along},
      theme::kBackground);
}

std::string text_of(double value) {
  char text[32];
  if (value < 0.0) return kMinus + text_of(-value);
  const double size = std::abs(value);
  const bool plain = size == 0.0 || (size >= 0.0005 && size < 99999.5);
  std::snprintf(text, sizeof text, plain && size >= 100.0 ? "%.0f" : "%.3g", value);
  return text;
}

std::string percent_of(double share) { return text_of(100.0 * share) + " %"; }

std::vector<Tick> ticks_between(double low, double high, int count) {
  std::vector<Tick> ticks;
  const double range = high - low;
  if (!(range > 0.0) || !std::isfinite(range)) return ticks;
  const double raw = range / std::max(1, count - 1);
  const double decade = std::pow(10.0, std::floor(std::log10(raw)));
  double step = 10.0 * decade;
  for (const double factor : {5.0, 2.5, 2.0, 1.0}) {
    if (factor * decade >= raw * (1.0 - 1e-9)) step = factor * decade;
  }
  const auto first = static_cast<long long>(std::ceil(low / step - 1e-9));
  const auto last = static_cast<long long>(std::floor(high / step + 1e-9));
  for (long long i = first; i <= last; ++i) {
    ticks.push_back({static_cast<double>(i) * step, {}});
    ticks.back().text = text_of(ticks.back().value);
  }
  // Two at least, or the scale could not be read.
  return ticks.size() < 2 ? ticks_between(low, high, count + 1) : ticks;
}

}  // namespace shoal::viz
