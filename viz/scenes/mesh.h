// Triangle meshes of spheres and lobes. Pure geometry: nothing here draws.
#pragma once

#include <array>
#include <cstdint>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "scenes/scene.h"
#include "sphere/coefficients.h"

namespace shoal::viz {

// A closed surface: every edge is shared by two triangles that run along it in opposite directions,
// and triangles turn counter-clockwise as seen from outside.
struct Mesh {
  std::vector<glm::vec3> positions;
  std::vector<glm::vec3> normals;  // of unit length, outwards, one a position
  std::vector<std::array<std::uint32_t, 3>> triangles;
  std::vector<float> values;  // what the surface shows, one a position; signed; empty on a sphere
};

// Enough for the lobes of degree 10 to look smooth in a window of their own.
inline constexpr int kFineRings = 64;

// A geodesic unit sphere on the octahedron: ring i of a hemisphere stands at the polar angle
// (pi/2) i/rings and holds 4i vertices, so that the six half axes are vertices exactly, and the
// octahedron's symmetries are the mesh's. 4 rings^2 + 2 vertices, 8 rings^2 triangles, edges
// between 1 and sqrt(1 + pi^2/4) = 1.87 times (pi/2)/rings. Precondition: rings >= 1.
[[nodiscard]] Mesh sphere_mesh(int rings);

// The surface r = scale |f(direction)| over the sphere's directions; `values` are f at its
// vertices. Normals are the area-weighted mean of those triangles around a vertex where f keeps the
// vertex's sign, so that the crease where it changes stays sharp; where r = 0 around it, the
// direction.
[[nodiscard]] Mesh lobe_mesh(const Mesh& sphere, std::span<const double> values,
                             double scale = 1.0);

// The function's RGB at every vertex of a sphere. The coefficients are of the frame in which the
// sphere is drawn (to_frame).
[[nodiscard]] std::vector<glm::dvec3> sample_on(const Mesh& sphere,
                                                const Coefficients& coefficients);

// The number that a channel is of a linear Rec.709 colour.
[[nodiscard]] double channel_of(const glm::dvec3& rgb, Channel channel);
[[nodiscard]] std::vector<double> channel_of(std::span<const glm::dvec3> rgb, Channel channel);

// The volume inside, by the divergence theorem; negative where triangles turn the wrong way.
[[nodiscard]] double signed_volume(const Mesh& mesh);

}  // namespace shoal::viz
