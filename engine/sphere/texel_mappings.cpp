#include "sphere/texel_mappings.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <glm/geometric.hpp>
#include <numbers>

namespace shoal {
namespace {

constexpr double kPi = std::numbers::pi;

// Where texels are at most this wide, half, the expansions below take the place of closed forms,
// which cost several times as much: what they leave out is of fourth order, 3e-10 here.
constexpr double kSmallHalf = 1.0 / 256.0;
// The face of an octahedron is nearer to its centre by sqrt(3) than that of a cube, where the
// function is steeper: 1e-10.
constexpr double kSmallOctahedralHalf = 1.0 / 1024.0;

// The solid angle of the triangle of three points, of which `determinant` is the determinant
// (Van Oosterom & Strackee, "The Solid Angle of a Plane Triangle", IEEE Trans. Biomed. Eng. 30(2),
// 1983, eq. 8). Without cancellation, however small the triangle.
double triangle_solid_angle(double determinant, const glm::dvec3& a, const glm::dvec3& b,
                            const glm::dvec3& c) {
  const double la = glm::length(a);
  const double lb = glm::length(b);
  const double lc = glm::length(c);
  const double below =
      la * lb * lc + glm::dot(a, b) * lc + glm::dot(a, c) * lb + glm::dot(b, c) * la;
  return 2.0 * std::atan2(determinant, below);
}

// Of a rectangle in the plane z = 1.
double rectangle_solid_angle(double s0, double s1, double t0, double t1) {
  const glm::dvec3 a(s0, t0, 1.0);
  const glm::dvec3 b(s1, t0, 1.0);
  const glm::dvec3 c(s1, t1, 1.0);
  const glm::dvec3 d(s0, t1, 1.0);
  const double area = (s1 - s0) * (t1 - t0);
  return triangle_solid_angle(area, a, b, c) + triangle_solid_angle(area, a, c, d);
}

// A point (u, v), u and v >= 0 and u + v <= 1, of a face of the octahedron.
glm::dvec3 on_octahedron(double u, double v) { return {u, v, 1.0 - u - v}; }

// Of the part with u + v <= 1 of the rectangle [u0, u1] x [v0, v1], u0 and v0 >= 0. The
// determinant of a triangle is twice its area in (u, v).
double octahedral_solid_angle(double u0, double u1, double v0, double v1) {
  const std::array<glm::dvec2, 4> corners = {glm::dvec2{u0, v0}, {u1, v0}, {u1, v1}, {u0, v1}};
  std::array<glm::dvec2, 6> polygon;
  std::size_t count = 0;
  for (std::size_t i = 0; i < 4; ++i) {
    const glm::dvec2 from = corners[i];
    const glm::dvec2 to = corners[(i + 1) % 4];
    const double from_inside = 1.0 - from.x - from.y;
    const double to_inside = 1.0 - to.x - to.y;
    if (from_inside >= 0.0) polygon[count++] = from;
    if (from_inside * to_inside < 0.0) {
      polygon[count++] = from + (to - from) * (from_inside / (from_inside - to_inside));
    }
  }
  double sum = 0.0;
  for (std::size_t i = 2; i < count; ++i) {
    const glm::dvec2 a = polygon[0];
    const glm::dvec2 b = polygon[i - 1];
    const glm::dvec2 c = polygon[i];
    const double determinant = (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
    sum += triangle_solid_angle(determinant, on_octahedron(a.x, a.y), on_octahedron(b.x, b.y),
                                on_octahedron(c.x, c.y));
  }
  return sum;
}

// The mean over a square of a function is f + half^2/6 (f_xx + f_yy) + O(half^4). On the
// octahedron, f = q^(-3/2) with q = u^2 + v^2 + w^2, w = 1 - u - v.
double small_octahedral_solid_angle(double u, double v, double half) {
  const double w = 1.0 - u - v;
  const double inverse = 1.0 / (u * u + v * v + w * w);
  const double slope_u = 2.0 * (u - w);
  const double slope_v = 2.0 * (v - w);
  const double bend = inverse * (3.75 * inverse * (slope_u * slope_u + slope_v * slope_v) - 12.0);
  return 4.0 * half * half * inverse * std::sqrt(inverse) * (1.0 + half * half / 6.0 * bend);
}

// pi sin(pi r)/r.
double angular_density(double r) {
  if (r < 1e-4) return kPi * kPi * (1.0 - kPi * kPi * r * r / 6.0);
  return kPi * std::sin(kPi * r) / r;
}

// The integral of the density over the square about (u, v).
double angular_solid_angle(double u, double v, double half) {
  // Gauss-Legendre of four nodes: exact to degree 7, so O(half^8).
  constexpr std::array<double, 4> kNodes = {-0.8611363115940526, -0.3399810435848563,
                                            0.3399810435848563, 0.8611363115940526};
  constexpr std::array<double, 4> kWeights = {0.3478548451374538, 0.6521451548625461,
                                              0.6521451548625461, 0.3478548451374538};
  double sum = 0.0;
  for (int i = 0; i < 4; ++i) {
    for (int j = 0; j < 4; ++j) {
      const double r = std::hypot(u + half * kNodes[i], v + half * kNodes[j]);
      sum += kWeights[i] * kWeights[j] * angular_density(r);
    }
  }
  return half * half * sum;
}

// The same as f + half^2/6 (f'' + f'/r), f the density.
double small_angular_solid_angle(double r, double sine, double cosine, double half) {
  double density = angular_density(r);
  double bend = -2.0 / 3.0 * kPi * kPi * kPi * kPi;  // at the centre
  if (r > 1e-2) {
    density = kPi * sine / r;
    bend = kPi * ((1.0 / (r * r) - kPi * kPi) * sine - kPi * cosine / r) / r;
  }
  return 4.0 * half * half * (density + half * half / 6.0 * bend);
}

// Directions in the native frame of coordinates in the frame of a picture's cube.
glm::dvec3 to_native(const glm::dmat3& native_to_cube, const glm::dvec3& direction) {
  return direction * native_to_cube;  // by the transposed, which is the inverse
}

// The faces of OpenEXR's cube are those of OpenGL's with z turned round (ImfEnvmap.cpp,
// CubeMap::pixelPosition and CubeMap::direction).
CubeFace openexr_face(int face) {
  CubeFace axes = cube_face(face < 4 ? face : 9 - face);
  axes.centre.z = -axes.centre.z;
  axes.right.z = -axes.right.z;
  axes.down.z = -axes.down.z;
  return axes;
}

// One letter a block: the number of a face, r for -z turned round, or nothing.
std::string_view blocks_of(Layout layout) {
  switch (layout) {
    case Layout::cube_vertical_cross:
      return " 2 140 3  r ";
    case Layout::cube_horizontal_cross:
      return " 2  1405 3  ";
    default:
      return "012345";
  }
}

// Half-open range of the places at which `shown` holds; they follow one another.
template <typename Shown>
std::array<int, 2> range_where(int count, const Shown& shown) {
  int begin = 0;
  while (begin < count && !shown(begin)) ++begin;
  int end = begin;
  while (end < count && shown(end)) ++end;
  return {begin, end};
}

template <typename Mapping>
double fill_texels(const Mapping& mapping, const TexelLine& line, const TexelSpan& span,
                   const TexelArrays& arrays) {
  double sum = 0.0;
  for (int i = span.begin; i < span.end; ++i) {
    const Texel texel =
        mapping.texel(line.row + i * line.row_step, line.column + i * line.column_step);
    const int at = i - span.begin;
    arrays.x[at] = static_cast<float>(texel.direction.x);
    arrays.y[at] = static_cast<float>(texel.direction.y);
    arrays.z[at] = static_cast<float>(texel.direction.z);
    arrays.solid_angle[at] = static_cast<float>(texel.solid_angle);
    sum += texel.solid_angle;
  }
  return sum;
}

}  // namespace

CubeFace cube_face(int face) {
  using V = glm::dvec3;
  switch (face) {
    case 0:
      return {V(1.0, 0.0, 0.0), V(0.0, 0.0, -1.0), V(0.0, -1.0, 0.0)};
    case 1:
      return {V(-1.0, 0.0, 0.0), V(0.0, 0.0, 1.0), V(0.0, -1.0, 0.0)};
    case 2:
      return {V(0.0, 1.0, 0.0), V(1.0, 0.0, 0.0), V(0.0, 0.0, 1.0)};
    case 3:
      return {V(0.0, -1.0, 0.0), V(1.0, 0.0, 0.0), V(0.0, 0.0, -1.0)};
    case 4:
      return {V(0.0, 0.0, 1.0), V(1.0, 0.0, 0.0), V(0.0, -1.0, 0.0)};
    default:
      return {V(0.0, 0.0, -1.0), V(-1.0, 0.0, 0.0), V(0.0, -1.0, 0.0)};
  }
}

std::vector<CubeBlock> cube_blocks(Layout layout) {
  const bool is_openexr = layout == Layout::cube_openexr;
  const Frame openexr{{2, 1}, {0, -1}, {1, 1}};
  const glm::dmat3 native_to_cube = native_to_frame(is_openexr ? openexr : cube_frame());
  std::vector<CubeBlock> blocks;
  for (const char letter : blocks_of(layout)) {
    CubeBlock block;
    if (letter != ' ') {
      block.number = letter == 'r' ? 5 : letter - '0';
      const CubeFace axes = is_openexr ? openexr_face(block.number) : cube_face(block.number);
      const double turn = letter == 'r' ? -1.0 : 1.0;
      block.face = {to_native(native_to_cube, axes.centre),
                    turn * to_native(native_to_cube, axes.right),
                    turn * to_native(native_to_cube, axes.down)};
    }
    blocks.push_back(block);
  }
  return blocks;
}

CubeMapping::CubeMapping(Layout layout, int edge) : edge_(edge), blocks_(cube_blocks(layout)) {
  const LayoutSize blocks = size_of(layout, 1);
  columns_ = blocks.width;
  rows_ = blocks.height;
  const bool is_openexr = layout == Layout::cube_openexr;
  sampling_ = is_openexr ? FaceSampling::endpoints : FaceSampling::centers;
  const bool on_edges = is_openexr && edge > 1;
  step_ = 2.0 / (on_edges ? edge - 1 : edge);
  first_ = on_edges ? -1.0 : 0.5 * step_ - 1.0;
}

double CubeMapping::solid_angle(int row, int column, double s, double t, double inverse) const {
  const double half = 0.5 * step_;
  const auto is_border = [&](int i) { return i == 0 || i == edge_ - 1; };
  const bool is_cut = sampling_ == FaceSampling::endpoints && (is_border(row) || is_border(column));
  if (half <= kSmallHalf && !is_cut) {
    // f = (1 + s^2 + t^2)^(-3/2); f_ss + f_tt = f (9/r^2 - 15/r^4).
    const double bend = inverse * (9.0 - 15.0 * inverse);
    return 4.0 * half * half * inverse * std::sqrt(inverse) * (1.0 + half * half / 6.0 * bend);
  }
  return rectangle_solid_angle(std::max(s - half, -1.0), std::min(s + half, 1.0),
                               std::max(t - half, -1.0), std::min(t + half, 1.0));
}

Texel CubeMapping::texel(int row, int column) const {
  const int block_row = row / edge_;
  const int block_column = column / edge_;
  const CubeFace& face = blocks_[block_row * columns_ + block_column].face;
  const int in_row = row - block_row * edge_;
  const int in_column = column - block_column * edge_;
  const double s = first_ + step_ * in_column;
  const double t = first_ + step_ * in_row;
  const glm::dvec3 place = face.centre + s * face.right + t * face.down;
  const double inverse = 1.0 / (1.0 + s * s + t * t);
  return {place * std::sqrt(inverse), solid_angle(in_row, in_column, s, t, inverse)};
}

std::array<int, 2> CubeMapping::row_range(int row) const {
  const auto range = range_where(
      columns_, [&](int column) { return blocks_[row / edge_ * columns_ + column].number >= 0; });
  return {range[0] * edge_, range[1] * edge_};
}

std::array<int, 2> CubeMapping::column_range(int column) const {
  const auto range = range_where(
      rows_, [&](int row) { return blocks_[row * columns_ + column / edge_].number >= 0; });
  return {range[0] * edge_, range[1] * edge_};
}

Texel DiscMapping::texel(int row, int column) const {
  const double half = 1.0 / size_;
  const double right = half * (2 * column + 1 - size_);
  const double down = half * (2 * row + 1 - size_);
  const double square = right * right + down * down;
  if (!is_angular_) {
    const double sideways = 2.0 * std::sqrt(std::max(0.0, 1.0 - square));
    return {glm::dvec3(2.0 * square - 1.0, -sideways * right, -sideways * down),
            16.0 * half * half};
  }
  const double r = std::sqrt(square);
  const double sine = std::sin(kPi * r);
  const double cosine = std::cos(kPi * r);
  const double sideways = r > 0.0 ? sine / r : kPi;
  return {glm::dvec3(-cosine, -sideways * right, -sideways * down),
          half <= kSmallHalf ? small_angular_solid_angle(r, sine, cosine, half)
                             : angular_solid_angle(right, down, half)};
}

std::array<int, 2> DiscMapping::range(int line) const {
  // In units of half a texel from the centre: (2j+1-n)^2 + across^2 <= n^2.
  const std::int64_t across = 2 * std::int64_t{line} + 1 - size_;
  const std::int64_t most = std::int64_t{size_} * size_ - across * across;
  auto reach = static_cast<std::int64_t>(std::sqrt(static_cast<double>(most)));
  while (reach * reach > most) --reach;
  while ((reach + 1) * (reach + 1) <= most) ++reach;
  const std::int64_t begin = (size_ - reach) / 2;  // the first j with 2j+1-n >= -reach
  return {static_cast<int>(begin), static_cast<int>(size_ - begin)};
}

Texel OctahedralMapping::texel(int row, int column) const {
  const double half = 1.0 / size_;
  const int from_middle_u = 2 * column + 1 - size_;
  const int from_middle_v = 2 * row + 1 - size_;
  const double u = half * std::abs(from_middle_u);
  const double v = half * std::abs(from_middle_v);
  const double sign_x = from_middle_u < 0 ? -1.0 : 1.0;
  const double sign_y = from_middle_v < 0 ? -1.0 : 1.0;
  const int beyond = std::abs(from_middle_u) + std::abs(from_middle_v) - size_;  // the upper half
  const double height = -half * beyond;
  if (is_equal_area_) {
    const double r = 1.0 - std::abs(height);
    const double phi = r > 0.0 ? ((v - u) / r + 1.0) * kPi / 4.0 : 0.0;
    const double sideways = r * std::sqrt(2.0 - r * r);
    return {glm::dvec3(sign_x * sideways * std::cos(phi), sign_y * sideways * std::sin(phi),
                       std::copysign(1.0 - r * r, height)),
            4.0 * kPi * half * half};
  }
  // The lower half is the upper one, folded over the edge u + v = 1.
  const double x = beyond > 0 ? 1.0 - v : u;
  const double y = beyond > 0 ? 1.0 - u : v;
  const glm::dvec3 place(sign_x * x, sign_y * y, height);
  const bool is_folded = std::abs(beyond) < 2 || from_middle_u == 0 || from_middle_v == 0;
  if (!is_folded && half <= kSmallOctahedralHalf) {
    return {glm::normalize(place), small_octahedral_solid_angle(x, y, half)};
  }
  // A texel in the middle of an odd size lies in two quadrants alike.
  const double u0 = std::max(0.0, u - half);
  const double v0 = std::max(0.0, v - half);
  const double u1 = u + half;
  const double v1 = v + half;
  const double quadrants = (from_middle_u == 0 ? 2.0 : 1.0) * (from_middle_v == 0 ? 2.0 : 1.0);
  const double above = octahedral_solid_angle(u0, u1, v0, v1);
  const double below = octahedral_solid_angle(1.0 - v1, 1.0 - v0, 1.0 - u1, 1.0 - u0);
  return {glm::normalize(place), quadrants * (above + below)};
}

// Here, where the compiler can put texel() into the loop.
double CubeMapping::fill(const TexelLine& line, const TexelSpan& span,
                         const TexelArrays& arrays) const {
  return fill_texels(*this, line, span, arrays);
}

double DiscMapping::fill(const TexelLine& line, const TexelSpan& span,
                         const TexelArrays& arrays) const {
  return fill_texels(*this, line, span, arrays);
}

double OctahedralMapping::fill(const TexelLine& line, const TexelSpan& span,
                               const TexelArrays& arrays) const {
  return fill_texels(*this, line, span, arrays);
}

}  // namespace shoal
