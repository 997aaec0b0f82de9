// What holds for every surface that shoal-viz makes.
#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <glm/geometric.hpp>
#include <map>
#include <utility>

#include "scenes/mesh.h"

namespace shoal::test {

// No edge runs between two vertices twice in one direction, and every one runs in both: closed and
// oriented. V - E + F tells its kind: 2 a sphere, 0 a torus.
inline void expect_closed(const viz::Mesh& mesh, long euler_characteristic) {
  std::map<std::pair<std::uint32_t, std::uint32_t>, int> edges;
  for (const auto& [a, b, c] : mesh.triangles) {
    ++edges[{a, b}];
    ++edges[{b, c}];
    ++edges[{c, a}];
  }
  for (const auto& [edge, count] : edges) {
    ASSERT_EQ(count, 1);
    ASSERT_TRUE(edges.contains({edge.second, edge.first}));
  }
  const auto vertices = static_cast<long>(mesh.positions.size());
  const auto faces = static_cast<long>(mesh.triangles.size());
  EXPECT_EQ(vertices - static_cast<long>(edges.size()) / 2 + faces, euler_characteristic);
}

inline void expect_finite_with_unit_normals(const viz::Mesh& mesh) {
  ASSERT_EQ(mesh.normals.size(), mesh.positions.size());
  for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
    for (int c = 0; c < 3; ++c) ASSERT_TRUE(std::isfinite(mesh.positions[i][c]));
    // Three roundings to float.
    ASSERT_NEAR(glm::length(glm::dvec3(mesh.normals[i])), 1.0, 2e-7);
  }
}

}  // namespace shoal::test
