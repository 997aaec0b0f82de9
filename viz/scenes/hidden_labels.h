// Words that go while something stands before them.
#pragma once

#include <vtkProp.h>
#include <vtkRenderer.h>

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <memory>

#include "scenes/mesh.h"

namespace shoal::viz {

// Whether the segment from a to b meets a triangle of the mesh.
[[nodiscard]] bool meets(const Mesh& mesh, const glm::vec3& a, const glm::vec3& b);

// A rectangle that faces the viewer.
struct FacingBox {
  glm::vec3 middle{0.0f};
  glm::dvec2 half{0.0};  // width and height, pixels
  std::shared_ptr<const Mesh> hidden_by;
};

// From now on each rendering of the view shows the prop, which may belong to another renderer that
// is drawn after it, only where nothing of the mesh stands before the box's middle and corners.
void hide_behind(vtkRenderer& view, vtkProp& prop, FacingBox box);

}  // namespace shoal::viz
