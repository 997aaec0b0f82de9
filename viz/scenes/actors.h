// Things that stand in a view.
#pragma once

#include <vtkRenderer.h>

#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>
#include <memory>
#include <span>
#include <string>

#include "scenes/colours.h"
#include "scenes/mesh.h"
#include "scenes/stage.h"
#include "sphere/frame.h"
#include "window/picture.h"

namespace shoal::viz {

enum class Shading {
  lit,    // by the view's lights, to tell the shape
  unlit,  // the colours as they are, where they are the message
};

// `colours` holds one sRGB colour a vertex.
void add_mesh(vtkRenderer& view, const Mesh& mesh, std::span<const glm::vec3> colours,
              Shading shading, const glm::vec3& center = {});

// One colour for values >= 0 and one for those below.
[[nodiscard]] std::vector<glm::vec3> sign_colours(const Mesh& lobe);

// An unlit ball on which an equirect picture of the native frame is seen from outside, drawn in
// `frame`: what lies in direction d of the panorama is at M d of the ball (native_to_frame).
void add_ball(vtkRenderer& view, const Picture& equirect, const Frame& frame,
              const glm::vec3& center = {}, double radius = 1.0);

// Pieces of line between pairs of points, in pixels of a window 720 high.
void add_lines(vtkRenderer& view, std::span<const glm::vec3> pairs, const glm::vec3& colour,
               double pixels = 1.0);

// A lit arrow; `thickness` is its shaft's radius, `opacity` in (0, 1].
void add_arrow(vtkRenderer& view, const glm::vec3& from, const glm::vec3& to,
               const glm::vec3& colour, double thickness = 0.02, double opacity = 1.0);

// Words that stand at a point and always face the viewer, in front of all else; their middle is at
// the point. While the mesh stands before a part of them, as seen by the view's camera, they are
// not there: on it they would name a place of it.
void add_label(Stage& stage, vtkRenderer& view, const glm::vec3& point, const std::string& text,
               TextSize size, const glm::vec3& colour = theme::kText,
               const std::shared_ptr<const Mesh>& hidden_by = nullptr);

// Looks at the target from viewer_direction (library/viewpoint.h), the frame's up being up, so that
// a ball of that radius there fills the view but for a margin. All views that are aimed alike show
// the same scale where their shapes agree.
void aim_camera(vtkRenderer& view, const Frame& frame, double radius, const glm::vec3& target = {});

}  // namespace shoal::viz
