// A panorama's function as a lobe surface, with what there is to say of it.
#pragma once

#include <glm/vec3.hpp>
#include <optional>
#include <vector>

#include "scenes/mesh.h"
#include "scenes/scene.h"

namespace shoal::viz {

struct Lobe {
  Mesh mesh;  // r = |f| / unit, in the settings' frame; values are f
  std::vector<glm::vec3> colours;
  int degree = 0;
  double unit = 1.0;  // what r = 1 stands for: the largest |f|, or 1 where f is zero
  double mean = 0.0;
  double largest = 0.0;  // of the mesh's vertices
  double smallest = 0.0;
  std::optional<glm::vec3> largest_direction;  // none where f is the same in all directions
};

// Of the settings' quantity, degree, channel, colour and frame. Precondition: rings >= 1.
[[nodiscard]] Lobe make_lobe(const Panorama& panorama, const SceneSettings& settings, int rings);

}  // namespace shoal::viz
