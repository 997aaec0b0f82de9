// Objects to be lit: meshes about as large as a unit ball, around the origin, z up.
#pragma once

#include "scenes/mesh.h"

namespace shoal::viz {

// A ring whose hole looks up and, tipped by a third of a right angle, towards -y: a polygon of
// kTorusPiecesAround corners at kTorusRing from its axis, thick as a polygon of kTorusPiecesOfTube
// corners at kTorusTube from that.
[[nodiscard]] Mesh torus_mesh();
inline constexpr int kTorusPiecesAround = 96;
inline constexpr int kTorusPiecesOfTube = 40;
inline constexpr double kTorusRing = 0.66;
inline constexpr double kTorusTube = 0.27;

// A bust: head, neck and shoulders on a plinth, an implicit surface that looks towards -y.
[[nodiscard]] Mesh bust_mesh();

}  // namespace shoal::viz
