// glTF 2.0 of one coloured mesh. Source: Khronos, "glTF 2.0 Specification", 2021.
#pragma once

#include <glm/vec3.hpp>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "scenes/mesh.h"
#include "sphere/frame.h"

namespace shoal::viz {

using GltfNotes = std::vector<std::pair<std::string, std::string>>;  // asset.extras

struct GltfModel {
  const Mesh& mesh;                       // in the frame's axes
  const std::vector<glm::vec3>& colours;  // sRGB, one a vertex; written linear, as COLOR_0 is
  Frame frame;
  GltfNotes notes;
};

// The .gltf: JSON, its buffer as base64 inside.
[[nodiscard]] std::string gltf_text(const GltfModel& model);

// The bytes of the .glb: header, JSON chunk, BIN chunk.
[[nodiscard]] std::string glb_text(const GltfModel& model);

}  // namespace shoal::viz
