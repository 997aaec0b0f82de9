#include "scenes/mesh.h"

#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

#include "sphere/basis.h"
#include "sphere/linear_operations.h"

namespace shoal::viz {
namespace {

// The vertices of the octahedral sphere by ring and place; ring 0 is the north pole, `rings` the
// equator, 2 rings the south pole.
class Rings {
 public:
  explicit Rings(int rings) : rings_(rings) {
    for (int ring = 0; ring <= 2 * rings; ++ring) {
      starts_.push_back(count_);
      count_ += size(ring);
    }
  }

  [[nodiscard]] int count() const { return count_; }
  // A quarter of the ring's vertices: 0 on the poles.
  [[nodiscard]] int quarter(int ring) const { return std::min(ring, 2 * rings_ - ring); }
  [[nodiscard]] int size(int ring) const { return std::max(1, 4 * quarter(ring)); }
  [[nodiscard]] std::uint32_t vertex(int ring, int place) const {
    return static_cast<std::uint32_t>(starts_[ring] + place % size(ring));
  }

 private:
  int rings_;
  int count_ = 0;
  std::vector<int> starts_;
};

// (cos, sin) of the part i/n of a right angle, exact at both ends and mirrored in the middle.
glm::dvec2 quarter_angle(int i, int n) {
  const auto sine = [](int j, int of) {
    return j == of ? 1.0 : std::sin(0.5 * std::numbers::pi * j / of);
  };
  return {sine(n - i, n), sine(i, n)};
}

void add_ring(const Rings& layout, int ring, int rings, std::vector<glm::vec3>& positions) {
  const glm::dvec2 polar = quarter_angle(layout.quarter(ring), rings);
  const double z = ring <= rings ? polar.x : -polar.x;
  const int quarter = layout.quarter(ring);
  if (quarter == 0) positions.emplace_back(0.0, 0.0, z);
  for (int place = 0; place < 4 * quarter; ++place) {
    const glm::dvec2 turn = polar.y * quarter_angle(place % quarter, quarter);
    const glm::dvec2 turned[] = {turn, {-turn.y, turn.x}, -turn, {turn.y, -turn.x}};
    positions.emplace_back(glm::dvec3(turned[place / quarter], z));
  }
}

// The triangles between ring `small` and its neighbour `large`, which is one step nearer to the
// equator. `flip` turns them where the larger ring lies to the north.
void add_belt(const Rings& layout, int small, int large, Mesh& mesh) {
  const bool north = small < large;
  const int quarter = layout.quarter(small);
  const auto add = [&](std::uint32_t a, std::uint32_t b, std::uint32_t c) {
    if (north) {
      mesh.triangles.push_back({a, b, c});
    } else {
      mesh.triangles.push_back({a, c, b});
    }
  };
  for (int side = 0; side < 4; ++side) {
    for (int j = 0; j <= quarter; ++j) {
      const std::uint32_t tip = layout.vertex(small, side * quarter + j);
      const int base = side * (quarter + 1) + j;
      add(tip, layout.vertex(large, base), layout.vertex(large, base + 1));
      if (j == quarter) continue;
      add(tip, layout.vertex(large, base + 1), layout.vertex(small, side * quarter + j + 1));
    }
  }
}

}  // namespace

Mesh sphere_mesh(int rings) {
  const Rings layout(rings);
  Mesh mesh;
  mesh.positions.reserve(layout.count());
  for (int ring = 0; ring <= 2 * rings; ++ring) add_ring(layout, ring, rings, mesh.positions);
  for (int ring = 0; ring < rings; ++ring) add_belt(layout, ring, ring + 1, mesh);
  for (int ring = 2 * rings; ring > rings; --ring) add_belt(layout, ring, ring - 1, mesh);
  mesh.normals = mesh.positions;
  return mesh;
}

Mesh lobe_mesh(const Mesh& sphere, std::span<const double> values, double scale) {
  Mesh mesh;
  mesh.triangles = sphere.triangles;
  mesh.values.assign(values.begin(), values.end());
  std::vector<glm::dvec3> positions(values.size());
  for (std::size_t i = 0; i < values.size(); ++i) {
    positions[i] = glm::dvec3(sphere.positions[i]) * (scale * std::abs(values[i]));
    mesh.positions.emplace_back(positions[i]);
  }
  std::vector<glm::dvec3> same_sign(values.size(), glm::dvec3(0.0));
  std::vector<glm::dvec3> any_sign(values.size(), glm::dvec3(0.0));
  for (const auto& [a, b, c] : mesh.triangles) {
    const glm::dvec3 area = glm::cross(positions[b] - positions[a], positions[c] - positions[a]);
    const bool positive = values[a] >= 0.0;
    const bool mixed = (values[b] >= 0.0) != positive || (values[c] >= 0.0) != positive;
    for (const std::uint32_t corner : {a, b, c}) {
      any_sign[corner] += area;
      if (!mixed) same_sign[corner] += area;
    }
  }
  mesh.normals.reserve(values.size());
  for (std::size_t i = 0; i < values.size(); ++i) {
    glm::dvec3 normal = same_sign[i];
    if (glm::length(normal) == 0.0) normal = any_sign[i];
    const double length = glm::length(normal);
    mesh.normals.emplace_back(length > 0.0 ? normal / length : glm::dvec3(sphere.positions[i]));
  }
  return mesh;
}

std::vector<glm::dvec3> sample_on(const Mesh& sphere, const Coefficients& coefficients) {
  const Basis<double> basis(coefficients.degree);
  std::vector<double> values(coefficient_count(coefficients.degree));
  std::vector<glm::dvec3> samples;
  samples.reserve(sphere.positions.size());
  for (const glm::vec3& position : sphere.positions) {
    basis.evaluate(glm::normalize(glm::dvec3(position)), values);
    samples.push_back(evaluate(coefficients, values));
  }
  return samples;
}

double channel_of(const glm::dvec3& rgb, Channel channel) {
  switch (channel) {
    case Channel::red:
      return rgb.r;
    case Channel::green:
      return rgb.g;
    case Channel::blue:
      return rgb.b;
    case Channel::luminance:
      break;
  }
  return luminance(rgb);
}

std::vector<double> channel_of(std::span<const glm::dvec3> rgb, Channel channel) {
  std::vector<double> values;
  values.reserve(rgb.size());
  for (const glm::dvec3& colour : rgb) values.push_back(channel_of(colour, channel));
  return values;
}

double signed_volume(const Mesh& mesh) {
  double volume = 0.0;
  for (const auto& [a, b, c] : mesh.triangles) {
    volume += glm::dot(glm::dvec3(mesh.positions[a]),
                       glm::cross(glm::dvec3(mesh.positions[b]), glm::dvec3(mesh.positions[c])));
  }
  return volume / 6.0;
}

}  // namespace shoal::viz
