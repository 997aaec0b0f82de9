#include "scenes/actors.h"

#include <vtkActor.h>
#include <vtkArrowSource.h>
#include <vtkBillboardTextActor3D.h>
#include <vtkCamera.h>
#include <vtkCellArray.h>
#include <vtkNew.h>
#include <vtkPoints.h>
#include <vtkPolyDataMapper.h>
#include <vtkProperty.h>
#include <vtkTextProperty.h>
#include <vtkTransform.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>
#include <vector>

#include "library/viewpoint.h"
#include "scenes/hidden_labels.h"
#include "scenes/type.h"
#include "scenes/vtk_data.h"

namespace shoal::viz {
namespace {

// Matt, with a faint highlight that tells the shape and leaves the colour readable.
void set_lit(vtkProperty& property) {
  property.SetInterpolationToPhong();
  property.SetAmbient(0.22);
  property.SetDiffuse(0.85);
  property.SetSpecular(0.10);
  property.SetSpecularPower(24.0);
}

void set_unlit(vtkProperty& property) {
  property.LightingOff();
  property.SetAmbient(1.0);
  property.SetDiffuse(0.0);
}

vtkActor& add_actor(vtkRenderer& view, vtkPolyData& data, Shading shading) {
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputData(&data);
  mapper->SetColorModeToDirectScalars();
  vtkNew<vtkActor> actor;
  actor->SetMapper(mapper);
  if (shading == Shading::lit) set_lit(*actor->GetProperty());
  if (shading == Shading::unlit) set_unlit(*actor->GetProperty());
  view.AddActor(actor);
  return *actor;
}

// Texture coordinates reach to the middle of the outermost rows, whose texels stand for the poles.
vtkSmartPointer<vtkPolyData> equirect_ball(int rows, int columns, PictureSize texels,
                                           const glm::dmat3& turn) {
  std::vector<TexturedPoint> points;
  for (int i = 0; i <= rows; ++i) {
    const double theta = std::numbers::pi * i / rows;
    const double v =
        std::clamp(1.0 - double(i) / rows, 0.5 / texels.height, 1.0 - 0.5 / texels.height);
    for (int j = 0; j <= columns; ++j) {
      const double phi = 2.0 * std::numbers::pi * j / columns;
      const glm::dvec3 native(std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi),
                              std::cos(theta));
      points.push_back({turn * native, {double(j) / columns, v}});
    }
  }
  std::vector<std::array<vtkIdType, 4>> faces;
  for (int i = 0; i < rows; ++i) {
    for (int j = 0; j < columns; ++j) {
      const vtkIdType a = i * (columns + 1) + j;
      const vtkIdType b = a + columns + 1;
      faces.push_back({a, b, b + 1, a + 1});
    }
  }
  return textured_poly_data(points, faces);
}

}  // namespace

void add_mesh(vtkRenderer& view, const Mesh& mesh, std::span<const glm::vec3> colours,
              Shading shading, const glm::vec3& center) {
  const auto data = to_poly_data(mesh);
  set_point_colours(*data, colours);
  add_actor(view, *data, shading).SetPosition(center.x, center.y, center.z);
}

std::vector<glm::vec3> sign_colours(const Mesh& lobe) {
  std::vector<glm::vec3> colours;
  colours.reserve(lobe.values.size());
  for (const float value : lobe.values) {
    colours.push_back(value < 0.0f ? theme::kNegative : theme::kPositive);
  }
  return colours;
}

void add_ball(vtkRenderer& view, const Picture& equirect, const Frame& frame,
              const glm::vec3& center, double radius) {
  constexpr int kRows = 64;
  const auto data = equirect_ball(kRows, 2 * kRows, equirect.size, native_to_frame(frame));
  vtkActor& actor = add_actor(view, *data, Shading::unlit);
  const auto texture = to_texture(equirect);
  texture->EdgeClampOff();
  texture->RepeatOn();  // smooth across the seam
  actor.SetTexture(texture);
  actor.SetPosition(center.x, center.y, center.z);
  actor.SetScale(radius);
}

void add_lines(vtkRenderer& view, std::span<const glm::vec3> pairs, const glm::vec3& colour,
               double pixels) {
  vtkNew<vtkPoints> points;
  vtkNew<vtkCellArray> cells;
  for (std::size_t i = 0; i + 1 < pairs.size(); i += 2) {
    const vtkIdType a = points->InsertNextPoint(pairs[i].x, pairs[i].y, pairs[i].z);
    const vtkIdType b = points->InsertNextPoint(pairs[i + 1].x, pairs[i + 1].y, pairs[i + 1].z);
    cells->InsertNextCell({a, b});
  }
  vtkNew<vtkPolyData> data;
  data->SetPoints(points);
  data->SetLines(cells);
  vtkProperty& property = *add_actor(view, *data, Shading::unlit).GetProperty();
  property.SetColor(colour.r, colour.g, colour.b);
  const int height = view.GetVTKWindow() != nullptr ? view.GetVTKWindow()->GetSize()[1] : 720;
  property.SetLineWidth(static_cast<float>(pixels * height / 720.0));
}

void add_arrow(vtkRenderer& view, const glm::vec3& from, const glm::vec3& to,
               const glm::vec3& colour, double thickness, double opacity) {
  const double length = glm::length(to - from);
  if (length == 0.0) return;
  vtkNew<vtkArrowSource> source;
  source->SetShaftRadius(thickness / length);
  source->SetTipRadius(3.0 * thickness / length);
  source->SetTipLength(std::min(0.5, 8.0 * thickness / length));
  source->SetShaftResolution(24);
  source->SetTipResolution(32);
  source->Update();
  vtkActor& actor = add_actor(view, *source->GetOutput(), Shading::lit);
  actor.GetProperty()->SetColor(colour.r, colour.g, colour.b);
  actor.GetProperty()->SetOpacity(opacity);
  actor.GetProperty()->BackfaceCullingOn();  // or a transparent one shows its far side
  // The source points along x; turn x to the direction by half a turn around the line between.
  const glm::dvec3 along = glm::dvec3(to - from) / length;
  glm::dvec3 middle = along + glm::dvec3(1.0, 0.0, 0.0);
  if (glm::length(middle) < 1e-6) middle = {0.0, 0.0, 1.0};
  vtkNew<vtkTransform> transform;
  transform->Translate(from.x, from.y, from.z);
  transform->RotateWXYZ(180.0, middle.x, middle.y, middle.z);
  transform->Scale(length, length, length);
  actor.SetUserTransform(transform);
}

void add_label(Stage& stage, vtkRenderer& view, const glm::vec3& point, const std::string& text,
               TextSize size, const glm::vec3& colour,
               const std::shared_ptr<const Mesh>& hidden_by) {
  vtkNew<vtkBillboardTextActor3D> actor;
  actor->SetInput(text.c_str());
  actor->SetPosition(point.x, point.y, point.z);
  vtkTextProperty& property = *actor->GetTextProperty();
  set_font(property, text);
  property.SetFontSize(stage.text_pixels(size));
  property.SetColor(colour.r, colour.g, colour.b);
  property.SetJustificationToCentered();
  property.SetVerticalJustificationToCentered();
  if (hidden_by != nullptr) {  // readable on whatever it stands before, and plainly not on it
    const glm::vec3& ground = theme::kBackground;
    property.SetBackgroundColor(ground.r, ground.g, ground.b);
    property.SetBackgroundOpacity(0.7);
  }
  stage.front_of(view).AddActor(actor);
  if (hidden_by == nullptr) return;
  const double half_width = 0.5 * stage.text_width(text, size) * stage.width();
  hide_behind(view, *actor, {point, {half_width, 0.35 * stage.text_pixels(size)}, hidden_by});
}

void aim_camera(vtkRenderer& view, const Frame& frame, double radius, const glm::vec3& target) {
  constexpr double kMargin = 1.04;
  constexpr double kViewAngle = 24.0;  // degrees; a narrow one bends shapes little
  const double* area = view.GetViewport();
  const int* size = view.GetVTKWindow()->GetSize();
  const double aspect = (area[2] - area[0]) * size[0] / ((area[3] - area[1]) * size[1]);
  const double half_angle = 0.5 * kViewAngle * std::numbers::pi / 180.0;
  const double narrow = std::atan(std::tan(half_angle) * std::min(1.0, aspect));
  const double distance = kMargin * radius / std::sin(narrow);
  const glm::vec3 eye = target + glm::vec3(distance * viewer_direction(frame));
  const glm::dvec3 up = direction_of(frame.up);
  vtkCamera& camera = *view.GetActiveCamera();
  camera.SetFocalPoint(target.x, target.y, target.z);
  camera.SetPosition(eye.x, eye.y, eye.z);
  camera.SetViewUp(up.x, up.y, up.z);
  camera.SetViewAngle(kViewAngle);
  camera.OrthogonalizeViewUp();
  camera.SetClippingRange(distance - 1.5 * radius, distance + 1.5 * radius);
}

}  // namespace shoal::viz
