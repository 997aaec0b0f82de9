// The project's data as VTK's.
#pragma once

#include <vtkFloatArray.h>
#include <vtkPolyData.h>
#include <vtkSmartPointer.h>
#include <vtkTexture.h>

#include <array>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <span>

#include "scenes/mesh.h"
#include "window/picture.h"

namespace shoal::viz {

// Points, normals, triangles and, where there are any, "value" a point.
[[nodiscard]] vtkSmartPointer<vtkPolyData> to_poly_data(const Mesh& mesh);

// Colours of points as bytes, named "colour", made the active scalars.
void set_point_colours(vtkPolyData& data, std::span<const glm::vec3> colours);

// A point that shows a place of a texture, (0, 0) its lower left corner.
struct TexturedPoint {
  glm::dvec3 position;
  glm::dvec2 place;
};

// Four-sided faces between points of that index.
[[nodiscard]] vtkSmartPointer<vtkPolyData> textured_poly_data(
    std::span<const TexturedPoint> points, std::span<const std::array<vtkIdType, 4>> faces);

// Smooth in between and where it is made smaller.
[[nodiscard]] vtkSmartPointer<vtkTexture> to_texture(const Picture& picture);

}  // namespace shoal::viz
