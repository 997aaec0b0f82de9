#include "scenes/exhibits.h"

#include <vtkCellArray.h>
#include <vtkDataArray.h>
#include <vtkFlyingEdges3D.h>
#include <vtkIdList.h>
#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <numbers>

namespace shoal::viz {
namespace {

// Signed distances, negative inside.
double ellipsoid(const glm::dvec3& p, const glm::dvec3& center, const glm::dvec3& radii) {
  const glm::dvec3 q = (p - center) / radii;
  const double length = glm::length(q);
  // To first order the distance of the surface |q| = 1, exact on it.
  return length > 0.0 ? length * (length - 1.0) / glm::length(q / radii) : -radii.x;
}

// A capsule whose radius goes from that at a to that at b; near enough to a distance for thin ones.
double limb(const glm::dvec3& p, const glm::dvec3& a, const glm::dvec3& b, double radius_a,
            double radius_b) {
  const double t = std::clamp(glm::dot(p - a, b - a) / glm::dot(b - a, b - a), 0.0, 1.0);
  return glm::length(p - a - t * (b - a)) - std::lerp(radius_a, radius_b, t);
}

// With a rounded rim, so that its normals are smooth.
double disc(const glm::dvec3& p, const glm::dvec3& center, double radius, double half_height) {
  constexpr double kRounding = 0.03;
  const glm::dvec3 q = p - center;
  const glm::dvec2 beyond(std::hypot(q.x, q.y) - radius + kRounding,
                          std::abs(q.z) - half_height + kRounding);
  return glm::length(glm::max(beyond, 0.0)) + std::min(std::max(beyond.x, beyond.y), 0.0) -
         kRounding;
}

// Unions and cuts that are round, `width` wide, where two bodies meet (the quadratic smooth
// minimum).
double join(double a, double b, double width) {
  const double h = std::max(width - std::abs(a - b), 0.0) / width;
  return std::min(a, b) - h * h * width / 4.0;
}

double carve(double body, double tool, double width) { return -join(-body, tool, width); }

// p, and `s`, its mirror image at the right: what is modelled there is on both sides.
double head(const glm::dvec3& p, const glm::dvec3& s) {
  double d = ellipsoid(p, {0.0, 0.06, 0.57}, {0.265, 0.33, 0.30});                    // skull
  d = join(d, ellipsoid(p, {0.0, -0.10, 0.45}, {0.215, 0.20, 0.28}), 0.12);           // face
  d = join(d, ellipsoid(p, {0.0, -0.22, 0.235}, {0.085, 0.085, 0.07}), 0.10);         // chin
  d = carve(d, ellipsoid(s, {0.095, -0.33, 0.53}, {0.068, 0.075, 0.045}), 0.06);      // sockets
  d = join(d, ellipsoid(s, {0.09, -0.247, 0.525}, {0.042, 0.035, 0.028}), 0.015);     // eyes
  d = join(d, limb(p, {0.0, -0.275, 0.57}, {0.0, -0.36, 0.43}, 0.022, 0.043), 0.05);  // nose
  d = join(d, ellipsoid(s, {0.035, -0.315, 0.42}, {0.03, 0.035, 0.025}), 0.03);       // its wings
  d = join(d, ellipsoid(p, {0.0, -0.29, 0.345}, {0.072, 0.04, 0.018}), 0.025);        // lips
  d = join(d, ellipsoid(p, {0.0, -0.286, 0.308}, {0.06, 0.04, 0.02}), 0.025);
  d = join(d, ellipsoid(s, {0.262, 0.04, 0.49}, {0.03, 0.065, 0.1}), 0.03);       // ears
  return join(d, ellipsoid(p, {0.0, 0.10, 0.615}, {0.295, 0.335, 0.275}), 0.04);  // hair
}

double shoulders(const glm::dvec3& p, const glm::dvec3& s) {
  double d = ellipsoid(s, {0.36, 0.08, -0.36}, {0.26, 0.20, 0.20});
  d = join(d, ellipsoid(p, {0.0, 0.06, -0.36}, {0.42, 0.24, 0.26}), 0.20);
  d = join(d, ellipsoid(p, {0.0, 0.0, -0.52}, {0.36, 0.25, 0.30}), 0.15);
  return join(d, limb(s, {0.0, 0.09, -0.02}, {0.42, 0.09, -0.25}, 0.10, 0.12), 0.12);
}

double bust(const glm::dvec3& p) {
  const glm::dvec3 s(std::abs(p.x), p.y, p.z);
  double d = head(p, s);
  d = join(d, limb(p, {0.0, 0.07, 0.3}, {0.0, 0.09, -0.12}, 0.15, 0.165), 0.10);  // neck
  d = join(d, shoulders(p, s), 0.08);
  d = carve(d, p.z + 0.70, 0.05);  // cut flat below the chest
  d = join(d, limb(p, {0.0, 0.04, -0.65}, {0.0, 0.04, -0.86}, 0.14, 0.13), 0.06);  // its stand
  return join(d, disc(p, {0.0, 0.02, -0.92}, 0.30, 0.06), 0.03);
}

Mesh mesh_of(vtkPolyData& data) {
  Mesh mesh;
  vtkDataArray& normals = *data.GetPointData()->GetNormals();
  for (vtkIdType i = 0; i < data.GetNumberOfPoints(); ++i) {
    double p[3];
    double n[3];
    data.GetPoint(i, p);
    normals.GetTuple(i, n);
    mesh.positions.emplace_back(p[0], p[1], p[2]);
    mesh.normals.push_back(glm::normalize(glm::vec3(n[0], n[1], n[2])));
  }
  vtkNew<vtkIdList> corners;
  for (vtkIdType i = 0; i < data.GetNumberOfCells(); ++i) {
    data.GetCellPoints(i, corners);
    mesh.triangles.push_back({static_cast<std::uint32_t>(corners->GetId(0)),
                              static_cast<std::uint32_t>(corners->GetId(1)),
                              static_cast<std::uint32_t>(corners->GetId(2))});
  }
  return mesh;
}

}  // namespace

Mesh torus_mesh() {
  constexpr double kTip = std::numbers::pi / 6.0;
  const auto tipped = [](const glm::dvec3& p) {
    return glm::vec3(p.x, std::cos(kTip) * p.y - std::sin(kTip) * p.z,
                     std::sin(kTip) * p.y + std::cos(kTip) * p.z);
  };
  Mesh mesh;
  for (int i = 0; i < kTorusPiecesAround; ++i) {
    for (int j = 0; j < kTorusPiecesOfTube; ++j) {
      const double a = 2.0 * std::numbers::pi * i / kTorusPiecesAround;
      const double b = 2.0 * std::numbers::pi * j / kTorusPiecesOfTube;
      const glm::dvec3 out(std::cos(a), std::sin(a), 0.0);
      const glm::dvec3 normal = std::cos(b) * out + glm::dvec3(0.0, 0.0, std::sin(b));
      mesh.positions.push_back(tipped(kTorusRing * out + kTorusTube * normal));
      mesh.normals.push_back(tipped(normal));
      const auto at = [&](int u, int v) {
        return static_cast<std::uint32_t>(((i + u) % kTorusPiecesAround) * kTorusPiecesOfTube +
                                          (j + v) % kTorusPiecesOfTube);
      };
      mesh.triangles.push_back({at(0, 0), at(1, 0), at(1, 1)});
      mesh.triangles.push_back({at(0, 0), at(1, 1), at(0, 1)});
    }
  }
  return mesh;
}

Mesh bust_mesh() {
  // Fine enough for eyelids, coarse enough to be lit by every texel while one waits.
  constexpr double kStep = 0.0195;
  const glm::dvec3 low(-0.68, -0.45, -1.02);
  const glm::ivec3 count(71, 52, 101);
  vtkNew<vtkImageData> grid;
  grid->SetDimensions(count.x, count.y, count.z);
  grid->SetOrigin(low.x, low.y, low.z);
  grid->SetSpacing(kStep, kStep, kStep);
  grid->AllocateScalars(VTK_FLOAT, 1);
  auto* values = static_cast<float*>(grid->GetScalarPointer());
  for (int k = 0; k < count.z; ++k) {
    for (int j = 0; j < count.y; ++j) {
      for (int i = 0; i < count.x; ++i) {
        // Inside is larger, so that gradients point inwards and normals outwards.
        *values++ = static_cast<float>(-bust(low + kStep * glm::dvec3(i, j, k)));
      }
    }
  }
  vtkNew<vtkFlyingEdges3D> surface;
  surface->SetInputData(grid);
  surface->SetValue(0, 0.0);
  surface->ComputeNormalsOn();
  surface->ComputeGradientsOff();
  surface->Update();
  return mesh_of(*surface->GetOutput());
}

}  // namespace shoal::viz
