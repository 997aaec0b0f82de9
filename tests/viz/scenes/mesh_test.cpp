#include "scenes/mesh.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

#include "sphere/basis.h"
#include "viz/scenes/mesh_checks.h"

namespace shoal::viz {
namespace {

constexpr double kPi = std::numbers::pi;

// The values of a function of the direction at a sphere's vertices.
template <typename F>
std::vector<double> values_of(const Mesh& sphere, F f) {
  std::vector<double> values;
  for (const glm::vec3& p : sphere.positions) values.push_back(f(glm::dvec3(p)));
  return values;
}

std::vector<double> values_of_basis(const Mesh& sphere, int l, int m) {
  const Basis<double> basis(l);
  std::vector<double> all(coefficient_count(l));
  return values_of(sphere, [&](const glm::dvec3& p) {
    basis.evaluate(glm::normalize(p), all);
    return all[coefficient_index(l, m)];
  });
}

double largest_radius(const Mesh& mesh) {
  double largest = 0.0;
  for (const glm::vec3& p : mesh.positions) largest = std::max<double>(largest, glm::length(p));
  return largest;
}

using test::expect_finite_with_unit_normals;

void expect_closed_sphere(const Mesh& mesh) { test::expect_closed(mesh, 2); }

TEST(SphereMesh, IsClosedOrientedAndASphere) {
  for (const int rings : {1, 2, 3, 7, 16}) {
    const Mesh mesh = sphere_mesh(rings);
    EXPECT_EQ(mesh.positions.size(), 4u * rings * rings + 2);
    EXPECT_EQ(mesh.triangles.size(), 8u * rings * rings);
    expect_closed_sphere(mesh);
    expect_finite_with_unit_normals(mesh);
    for (const glm::vec3& p : mesh.positions) {
      ASSERT_NEAR(glm::length(glm::dvec3(p)), 1.0, 2e-7);
    }
  }
}

TEST(SphereMesh, HasTheSixHalfAxesExactly) {
  const Mesh mesh = sphere_mesh(5);
  for (int axis = 0; axis < 3; ++axis) {
    for (const float sign : {-1.0f, 1.0f}) {
      glm::vec3 wish(0.0f);
      wish[axis] = sign;
      EXPECT_NE(std::find(mesh.positions.begin(), mesh.positions.end(), wish),
                mesh.positions.end());
    }
  }
}

// Neighbours on a ring next to the pole are pi/2 times the rings' distance apart, the most there
// is; so a triangle's legs are at least 1 and at most pi/2, and what spans them sqrt(1 + pi^2/4).
TEST(SphereMesh, HasEdgesAsLongAsItSays) {
  const int rings = 24;
  const Mesh mesh = sphere_mesh(rings);
  const double step = 0.5 * kPi / rings;
  for (const auto& triangle : mesh.triangles) {
    for (int k = 0; k < 3; ++k) {
      const double chord = glm::distance(glm::dvec3(mesh.positions[triangle[k]]),
                                         glm::dvec3(mesh.positions[triangle[(k + 1) % 3]]));
      const double angle = 2.0 * std::asin(0.5 * chord);
      ASSERT_GE(angle, step * (1.0 - 1e-5));
      ASSERT_LE(angle, step * std::sqrt(1.0 + 0.25 * kPi * kPi));
    }
  }
}

// r = |f| encloses the volume (1/3) integral |f|^3. Inscribed triangles fall short by O(h^2): with
// triangles of circumradius rho <= h = (pi/2)^2/rings a polyhedron in the unit sphere holds one of
// radius cos(h), so it misses at most 1 - cos^3 h < 1.5 h^2.
TEST(LobeMesh, OfY00IsABallOfItsVolume) {
  const Mesh sphere = sphere_mesh(kFineRings);
  const Mesh lobe = lobe_mesh(sphere, values_of_basis(sphere, 0, 0));
  const double y00 = 0.5 / std::sqrt(kPi);
  const double exact = 4.0 / 3.0 * kPi * std::pow(y00, 3);
  const double h = 0.25 * kPi * kPi / kFineRings;
  EXPECT_LT(signed_volume(lobe), exact);
  EXPECT_GT(signed_volume(lobe), exact * (1.0 - 1.5 * h * h));
}

// f = k cos, k = sqrt(3/(4 pi)): (1/3) k^3 2 pi integral |x|^3 dx over [-1, 1] = pi k^3/3. Y_1-1
// and Y_11 are the same lobe around y and x. The bound is twice that of the ball: the surface is
// two balls, each with half of the mesh.
TEST(LobeMesh, OfDegreeOneIsTwoBallsOfTheirVolume) {
  const Mesh sphere = sphere_mesh(kFineRings);
  const double exact = kPi / 3.0 * std::pow(3.0 / (4.0 * kPi), 1.5);
  const double h = 0.25 * kPi * kPi / kFineRings;
  for (const int m : {-1, 0, 1}) {
    const double volume = signed_volume(lobe_mesh(sphere, values_of_basis(sphere, 1, m)));
    EXPECT_NEAR(volume, exact, exact * 3.0 * h * h) << m;
  }
}

// f = 1 + cos: (1/3) 2 pi integral (1+x)^3 dx over [-1, 1] = 8 pi/3. Halving h divides the error of
// a smooth surface by four.
TEST(LobeMesh, ConvergesWithTheSquareOfItsEdges) {
  const auto error = [](int rings) {
    const Mesh sphere = sphere_mesh(rings);
    const auto values = values_of(sphere, [](const glm::dvec3& p) { return 1.0 + p.z; });
    return 8.0 * kPi / 3.0 - signed_volume(lobe_mesh(sphere, values));
  };
  EXPECT_GT(error(32), 0.0);
  EXPECT_NEAR(error(16) / error(32), 4.0, 0.1);
  EXPECT_NEAR(error(32) / error(64), 4.0, 0.1);
}

// |Y_l0| is largest at the poles, sqrt((2l+1)/(4 pi)); |Y_ll| on the equator at phi = 0:
// sqrt(2) sqrt((2l+1)!!/(4 pi (2l)!!)). All of these are vertices, up to rounding to float.
TEST(LobeMesh, ReachesTheExtremaOfTheBasis) {
  const Mesh sphere = sphere_mesh(16);
  double ratio = 1.0;  // (2l+1)!!/(2l)!!
  for (int l = 1; l <= 10; ++l) {
    ratio *= (2.0 * l + 1.0) / (2.0 * l);
    const double zonal = std::sqrt((2.0 * l + 1.0) / (4.0 * kPi));
    const double sectoral = std::sqrt(2.0 * ratio / (4.0 * kPi));
    EXPECT_NEAR(largest_radius(lobe_mesh(sphere, values_of_basis(sphere, l, 0))), zonal,
                2e-7 * zonal);
    EXPECT_NEAR(largest_radius(lobe_mesh(sphere, values_of_basis(sphere, l, l))), sectoral,
                2e-7 * sectoral);
  }
}

TEST(LobeMesh, StaysClosedFiniteAndOutward) {
  const Mesh sphere = sphere_mesh(12);
  for (int l = 0; l <= 6; ++l) {
    for (int m = -l; m <= l; ++m) {
      const Mesh lobe = lobe_mesh(sphere, values_of_basis(sphere, l, m), 2.0);
      expect_closed_sphere(lobe);
      expect_finite_with_unit_normals(lobe);
      EXPECT_GT(signed_volume(lobe), 0.0);
    }
  }
}

TEST(LobeMesh, OfNothingIsAPointWithNormals) {
  const Mesh sphere = sphere_mesh(4);
  const Mesh lobe = lobe_mesh(sphere, std::vector<double>(sphere.positions.size(), 0.0));
  expect_finite_with_unit_normals(lobe);
  EXPECT_EQ(lobe.normals, sphere.normals);
  EXPECT_EQ(largest_radius(lobe), 0.0);
}

// r = |cos theta| is two balls of diameter 1 around (0, 0, +-1/2), so the normal at p is
// (p - centre)/(1/2). Next to the crease at the origin only triangles of the vertex's own sign
// count, so it stays sharp there.
TEST(LobeMesh, HasTheNormalsOfItsSurface) {
  const Mesh sphere = sphere_mesh(kFineRings);
  const auto values = values_of(sphere, [](const glm::dvec3& p) { return p.z; });
  const Mesh lobe = lobe_mesh(sphere, values);
  double worst = 1.0;
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (values[i] == 0.0) continue;  // at the crease itself there are two normals
    const glm::dvec3 center(0.0, 0.0, values[i] > 0.0 ? 0.5 : -0.5);
    const glm::dvec3 exact = 2.0 * (glm::dvec3(lobe.positions[i]) - center);
    worst = std::min(worst, glm::dot(exact, glm::dvec3(lobe.normals[i])));
  }
  EXPECT_GT(worst, std::cos(3.0 * kPi / 180.0));
}

TEST(Channel, LuminanceIsThatOfRec709) {
  EXPECT_DOUBLE_EQ(channel_of({1.0, 1.0, 1.0}, Channel::luminance), 1.0);
  EXPECT_DOUBLE_EQ(channel_of({1.0, 0.0, 0.0}, Channel::luminance), 0.2126);
  EXPECT_EQ(channel_of({1.0, 2.0, 3.0}, Channel::red), 1.0);
  EXPECT_EQ(channel_of({1.0, 2.0, 3.0}, Channel::green), 2.0);
  EXPECT_EQ(channel_of({1.0, 2.0, 3.0}, Channel::blue), 3.0);
}

}  // namespace
}  // namespace shoal::viz
