#include "scenes/stage.h"

#include <vtkActor.h>
#include <vtkCamera.h>
#include <vtkLight.h>
#include <vtkNew.h>
#include <vtkPolyData.h>
#include <vtkPolyDataMapper.h>
#include <vtkProperty.h>
#include <vtkRendererCollection.h>
#include <vtkTextActor.h>
#include <vtkTextProperty.h>
#include <vtkTexture.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <sstream>
#include <string_view>
#include <vector>

#include "scenes/type.h"
#include "scenes/vtk_data.h"

namespace shoal::viz {
namespace {

constexpr double kMargin = 0.028;       // of the window's height, around everything
constexpr double kMostFlats = 65536.0;  // flat things in a layer, each at a depth of its own
constexpr int kBackdropLayer = 0;
constexpr int kViewLayer = 1;
constexpr int kFrontLayer = 2;
constexpr int kOverlayLayer = 3;
constexpr int kSheetLayer = 4;

void set_style(vtkTextProperty& property, const std::string& text, int pixels,
               const TextStyle& style) {
  set_font(property, text);
  property.SetFontSize(pixels);
  property.SetColor(style.colour.r, style.colour.g, style.colour.b);
  property.SetBold(style.size == TextSize::title);
  property.SetVerticalJustificationToBottom();
  if (style.align == TextAlign::left) property.SetJustificationToLeft();
  if (style.align == TextAlign::center) property.SetJustificationToCentered();
  if (style.align == TextAlign::right) property.SetJustificationToRight();
}

vtkSmartPointer<vtkRenderer> full_layer(vtkRenderWindow& window, int layer) {
  auto renderer = vtkSmartPointer<vtkRenderer>::New();
  renderer->SetLayer(layer);
  renderer->InteractiveOff();
  renderer->SetBackground(theme::kBackground.r, theme::kBackground.g, theme::kBackground.b);
  renderer->SetAutomaticLightCreation(false);
  // A unit of this layer's space is a pixel; larger z lies on top.
  const double width = window.GetSize()[0];
  const double height = window.GetSize()[1];
  vtkCamera& camera = *renderer->GetActiveCamera();
  camera.SetParallelProjection(true);
  camera.SetParallelScale(0.5 * height);
  camera.SetFocalPoint(0.5 * width, 0.5 * height, 0.0);
  camera.SetPosition(0.5 * width, 0.5 * height, kMostFlats + 1.0);
  camera.SetClippingRange(0.5, kMostFlats + 2.0);
  window.AddRenderer(renderer);
  return renderer;
}

vtkRenderWindow& cleared(vtkRenderWindow& window) {
  while (vtkRenderer* renderer = window.GetRenderers()->GetFirstRenderer()) {
    window.RemoveRenderer(renderer);
  }
  window.SetNumberOfLayers(kOverlayLayer + 1);
  return window;
}

// Two lights that travel with the camera: a key from the upper left, and a dim one that keeps what
// is turned away from it readable.
void light_view(vtkRenderer& view) {
  const struct {
    double position[3];
    double intensity;
  } lights[] = {{{-0.7, 0.9, 1.0}, 0.75}, {{0.6, -0.1, 1.0}, 0.40}};
  for (const auto& wish : lights) {
    vtkNew<vtkLight> light;
    light->SetLightTypeToCameraLight();
    light->SetPosition(wish.position[0], wish.position[1], wish.position[2]);
    light->SetFocalPoint(0.0, 0.0, 0.0);
    light->SetIntensity(wish.intensity);
    view.AddLight(light);
  }
}

// The whole of a texture.
vtkSmartPointer<vtkPolyData> quad(const Rectangle& area) {
  const auto& [left, bottom, right, top] = area;
  const TexturedPoint corners[] = {{{left, bottom, 0.0}, {0.0, 0.0}},
                                   {{right, bottom, 0.0}, {1.0, 0.0}},
                                   {{right, top, 0.0}, {1.0, 1.0}},
                                   {{left, top, 0.0}, {0.0, 1.0}}};
  const std::array<vtkIdType, 4> face = {0, 1, 2, 3};
  return textured_poly_data(corners, std::span(&face, 1));
}

}  // namespace

Stage::Stage(vtkRenderWindow& window) : Stage(cleared(window), kBackdropLayer, kOverlayLayer) {}

Stage::Stage(vtkRenderWindow& window, int backdrop_layer, int overlay_layer)
    : window_(window),
      width_(window.GetSize()[0]),
      height_(window.GetSize()[1]),
      backdrop_(full_layer(window, backdrop_layer)),
      overlay_(full_layer(window, overlay_layer)) {
  const double side = kMargin * height_ / width_;
  body_ = {side, kMargin, 1.0 - side, 1.0 - kMargin};
}

Stage Stage::over(vtkRenderWindow& window) {
  window.SetNumberOfLayers(kSheetLayer + 1);
  return Stage(window, kSheetLayer, kSheetLayer);
}

void Stage::take_away() {
  window_.RemoveRenderer(backdrop_);
  window_.RemoveRenderer(overlay_);
}

double Stage::aspect(const Rectangle& area) const {
  return area.width() * width_ / (area.height() * height_);
}

Rectangle Stage::fit(const Rectangle& area, double wished) const {
  const double shrink = wished / aspect(area);
  const double half_width = 0.5 * area.width() * std::min(1.0, shrink);
  const double half_height = 0.5 * area.height() / std::max(1.0, shrink);
  return {area.center_x() - half_width, area.center_y() - half_height, area.center_x() + half_width,
          area.center_y() + half_height};
}

int Stage::text_pixels(TextSize size) const {
  constexpr double kPixelsAt720[] = {26.0, 20.0, 16.0, 14.0};
  const double scale = std::min(height_ / 720.0, width_ / 960.0);
  const double pixels = kPixelsAt720[static_cast<int>(size)] * scale;
  return std::max(11, static_cast<int>(std::lround(pixels)));
}

double Stage::line_height(TextSize size) const { return 1.4 * text_pixels(size) / height_; }

double Stage::text_width(const std::string& text, TextSize size) const {
  vtkNew<vtkTextProperty> property;
  set_style(*property, text, text_pixels(size), TextStyle{.size = size});
  return measured_width(drawable(text, *property), *property) / width_;
}

void Stage::set_title(const std::string& title, const std::string& subject) {
  const double y = body_.top - line_height(TextSize::title) * 0.8;
  const double gap = 0.8 * kMargin;
  const double wished = text_width(title, TextSize::title);
  const double beside = body_.width() - gap - text_width(subject, TextSize::heading);
  const double width = std::min(wished, std::max(beside, 0.667 * body_.width()));
  add_text(body_.left, y, title,
           {.size = TextSize::title, .max_width = width + 0.5 / width_, .cut = TextCut::middle});
  add_text(body_.left + width + gap, y, subject,
           {.size = TextSize::heading,
            .colour = theme::kDimText,
            .max_width = std::max(0.0, body_.width() - width - gap) + 0.5 / width_});
  body_.top = y - 0.5 * kMargin;
}

std::string Stage::clauses_within(const std::string& text, TextSize size, double width) const {
  std::string kept = text;
  while (text_width(kept, size) > width) {
    const std::size_t end = kept.rfind("; ");
    if (end == std::string::npos) break;
    kept.resize(end);
  }
  return kept;
}

std::vector<std::string> Stage::wrapped(const std::string& text, TextSize size,
                                        double width) const {
  if (text_width(text, size) <= width) return {text};
  std::vector<std::string> lines(1);
  std::istringstream words(text);
  for (std::string word; words >> word;) {
    std::string& line = lines.back();
    const std::string longer = line.empty() ? word : line + " " + word;
    if (line.empty() || text_width(longer, size) <= width) {
      line = longer;
    } else {
      lines.push_back(word);
    }
  }
  return lines;
}

void Stage::set_caption(std::span<const std::string> lines, double max_width) {
  const double width = std::min(max_width, body_.width());
  std::vector<std::string> fitting;
  for (std::string rest : lines) {
    while (!rest.empty()) {
      const std::string clauses = clauses_within(rest, TextSize::label, width);
      rest.erase(0, clauses.size() + std::string_view("; ").size());
      std::ranges::move(wrapped(clauses, TextSize::label, width), std::back_inserter(fitting));
    }
  }
  const double step = line_height(TextSize::label);
  double y = body_.bottom + step * static_cast<double>(fitting.size() - 1);
  body_.bottom = y + step + 0.3 * kMargin;
  for (const std::string& line : fitting) {
    add_text(body_.left, y, line, {.colour = theme::kDimText, .max_width = width});
    y -= step;
  }
}

vtkRenderer& Stage::add_view(const Rectangle& area) {
  vtkNew<vtkRenderer> view;
  view->SetLayer(kViewLayer);
  view->SetViewport(area.left, area.bottom, area.right, area.top);
  view->SetAutomaticLightCreation(false);
  light_view(*view);
  window_.AddRenderer(view);
  return *view;
}

vtkRenderer& Stage::front_of(vtkRenderer& view) {
  vtkRenderer*& front = fronts_[&view];
  if (front == nullptr) {
    vtkNew<vtkRenderer> made;
    made->SetLayer(kFrontLayer);
    made->SetViewport(view.GetViewport());
    made->SetActiveCamera(view.GetActiveCamera());
    made->InteractiveOff();
    window_.AddRenderer(made);
    front = made;
  }
  return *front;
}

void Stage::add_text(double x, double y, const std::string& text, const TextStyle& style) {
  if (text.empty() || style.max_width <= 0.0) return;
  vtkNew<vtkTextActor> actor;
  vtkTextProperty& property = *actor->GetTextProperty();
  set_style(property, text, text_pixels(style.size), style);
  const std::string drawn = drawable(text, property);
  actor->SetInput(shortened(drawn, property, style.max_width * width_, style.cut).c_str());
  // Whole pixels: type between them would be blurred.
  actor->SetPosition(std::lround(x * width_), std::lround(y * height_));
  overlay_->AddActor2D(actor);
}

void Stage::add_picture(const Rectangle& area, const Picture& picture) {
  vtkActor& actor =
      add_flat(*overlay_, {std::round(area.left * width_), std::round(area.bottom * height_),
                           std::round(area.right * width_), std::round(area.top * height_)});
  actor.SetTexture(to_texture(picture));
}

// Flat things are solid geometry because VTK lets its own two-dimensional actors lie on one another
// in no promised order.
vtkActor& Stage::add_flat(vtkRenderer& layer, const Rectangle& pixels) {
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputData(quad(pixels));
  vtkNew<vtkActor> actor;
  actor->SetMapper(mapper);
  actor->SetPosition(0.0, 0.0, next_flat_++);
  actor->GetProperty()->LightingOff();
  layer.AddActor(actor);
  return *actor;
}

void Stage::add_rectangle(vtkRenderer& layer, const Rectangle& area, const glm::vec3& colour) {
  vtkActor& actor = add_flat(
      layer, {area.left * width_, area.bottom * height_, area.right * width_, area.top * height_});
  actor.GetProperty()->SetColor(colour.r, colour.g, colour.b);
}

void Stage::add_panel(const Rectangle& area, const glm::vec3& colour) {
  add_rectangle(*backdrop_, area, colour);
}

void Stage::add_box(const Rectangle& area, const glm::vec3& colour) {
  add_rectangle(*overlay_, area, colour);
}

double Stage::line_thickness() const { return std::max(1.0, std::round(height_ / 720.0)); }

void Stage::add_outline(const Rectangle& area, const glm::vec3& colour) {
  const double thick = line_thickness();
  const double across = thick / width_;
  const double along = thick / height_;
  add_box({area.left, area.bottom, area.right, area.bottom + along}, colour);
  add_box({area.left, area.top - along, area.right, area.top}, colour);
  add_box({area.left, area.bottom, area.left + across, area.top}, colour);
  add_box({area.right - across, area.bottom, area.right, area.top}, colour);
}

}  // namespace shoal::viz
