#include "scenes/exhibits.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <numbers>

#include "viz/scenes/mesh_checks.h"

namespace shoal::viz {
namespace {

constexpr double kPi = std::numbers::pi;

// Each vertex's normal looks to the outer side of the triangles around it.
void expect_normals_on_the_outer_side(const Mesh& mesh) {
  for (const auto& [a, b, c] : mesh.triangles) {
    const glm::dvec3 pa(mesh.positions[a]);
    const glm::dvec3 area =
        glm::cross(glm::dvec3(mesh.positions[b]) - pa, glm::dvec3(mesh.positions[c]) - pa);
    const glm::dvec3 mean(mesh.normals[a] + mesh.normals[b] + mesh.normals[c]);
    ASSERT_GT(glm::dot(area, mean), 0.0);
  }
}

TEST(TorusMesh, IsClosedOrientedAndATorus) {
  const Mesh mesh = torus_mesh();
  test::expect_closed(mesh, 0);
  test::expect_finite_with_unit_normals(mesh);
  expect_normals_on_the_outer_side(mesh);
}

// A torus holds 2 pi^2 R r^2. Its quadrilaterals are plane (two edges are parallel to the same
// chord), so what the mesh holds is known exactly: N pieces, each swept straight along a chord by a
// polygon of area A = (n/2) sin(2 pi/n) r^2, hold N sin(2 pi/N) R A. The positions are rounded to
// float.
TEST(TorusMesh, HoldsItsVolume) {
  const double around = kTorusPiecesAround;
  const double tube = kTorusPiecesOfTube;
  const double volume = signed_volume(torus_mesh());
  const double smooth = 2.0 * kPi * kPi * kTorusRing * kTorusTube * kTorusTube;
  const double shortfall = around / (2.0 * kPi) * std::sin(2.0 * kPi / around) * tube /
                           (2.0 * kPi) * std::sin(2.0 * kPi / tube);
  EXPECT_NEAR(volume, smooth * shortfall, smooth * 1e-6);
  EXPECT_NEAR(volume, smooth, smooth * 0.006);
}

TEST(BustMesh, IsOneClosedOrientedSurfaceWithoutHandles) {
  const Mesh mesh = bust_mesh();
  test::expect_closed(mesh, 2);
  test::expect_finite_with_unit_normals(mesh);
  expect_normals_on_the_outer_side(mesh);
  EXPECT_GT(signed_volume(mesh), 0.0);
}

// It stands upright and looks towards -y: the head is narrower than the shoulders, and what is
// farthest to the front at the head's height is the nose, in the middle.
TEST(BustMesh, HasItsFaceInFront) {
  const Mesh mesh = bust_mesh();
  glm::vec3 nose(0.0f, 1.0f, 0.0f);
  float head = 0.0f;
  float shoulders = 0.0f;
  for (const glm::vec3& p : mesh.positions) {
    EXPECT_LE(glm::length(p), 1.2f);
    if (p.z > 0.3f && p.y < nose.y) nose = p;
    (p.z > 0.3f ? head : shoulders) = std::max(p.z > 0.3f ? head : shoulders, std::abs(p.x));
  }
  EXPECT_NEAR(nose.x, 0.0f, 0.03f);
  EXPECT_LT(nose.y, -0.3f);
  EXPECT_LT(head, 0.7f * shoulders);
}

}  // namespace
}  // namespace shoal::viz
