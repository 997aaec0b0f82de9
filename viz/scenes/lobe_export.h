// A panorama's lobes as files for other programs.
#pragma once

#include <filesystem>

#include "core/result.h"
#include "scenes/scene.h"

namespace shoal::viz {

// The lobe surface that the lobes scene shows, of the same settings: r = |f(direction)| over the
// mean of f, coloured by sign or by the light. The path's extension says the format:
//
// .vtp    VTK's XML: points in the frame's axes, normals, "colour" (bytes), "value" (signed f).
// .glb    glTF 2.0 in one file; .gltf the same as JSON with the numbers inlined in base64. Points,
//         normals and vertex colours (COLOR_0, linear, as glTF has them). glTF's up is +y and its
//         front +z; a node turns the frame's up and centre there. It mirrors nothing: where up,
//         centre and right are a left-handed triple, the frame's right comes to glTF's -x instead
//         of +x. asset.extras says which frame and quantity the numbers are in.
//
// The file appears whole or not at all. Errors: usage (another extension), write_failed.
[[nodiscard]] Status write_lobes(const SceneInput& input, const std::filesystem::path& path);

}  // namespace shoal::viz
