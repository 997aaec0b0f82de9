// The mappings of squares to directions of which layouts are made, in the native frame.
//
// Solid angles are within 1e-9 of the mean texel's: closed forms, or where texels are small the
// first terms of their expansion, which then differ by less.
#pragma once

#include <array>
#include <glm/vec3.hpp>
#include <vector>

#include "sphere/layout.h"

namespace shoal {

struct Texel {
  glm::dvec3 direction{0.0};  // of its centre; unit length
  double solid_angle = 0.0;   // sr
};

// Texels of a picture one after the other, along a row or along a column, in either direction.
struct TexelLine {
  int row = 0;     // of the first
  int column = 0;  // of the first
  int row_step = 0;
  int column_step = 1;
  int count = 0;
};

// Those texels of a line that show some of the sphere: they follow one another. What lies outside
// of the arms of a cross or of a disc holds anything, and is never looked at.
struct TexelSpan {
  int begin = 0;
  int end = 0;

  [[nodiscard]] int size() const { return end - begin; }
};

// Planar, each of as many numbers as there are texels.
struct TexelArrays {
  float* x = nullptr;
  float* y = nullptr;
  float* z = nullptr;
  float* solid_angle = nullptr;
};

// A face of a cube: what its texel (s, t) in [-1, 1]^2, s to the right and t downwards, looks at
// is centre + s right + t down.
struct CubeFace {
  glm::dvec3 centre{0.0};
  glm::dvec3 right{0.0};
  glm::dvec3 down{0.0};
};

inline constexpr int kCubeFaceCount = 6;  // +x -x +y -y +z -z

// Faces of the cube in its own axes, as OpenGL and Direct3D lay them out.
[[nodiscard]] CubeFace cube_face(int face);

// A square of a cube's picture, as large as a face.
struct CubeBlock {
  CubeFace face;    // in the native frame, turned as the picture shows it
  int number = -1;  // of the face; -1: shows nothing
};

// The blocks of a cube's picture, row by row. Precondition: a cube's layout.
[[nodiscard]] std::vector<CubeBlock> cube_blocks(Layout layout);

// Where the texels of a face are sampled.
enum class FaceSampling {
  centers,    // half a texel away from the face's edges
  endpoints,  // border texels on the edges; a texel shows the cell around it that is on its face
};

// Cubes: a picture of square blocks, some of which show a face.
class CubeMapping {
 public:
  // Precondition: a cube's layout; edge >= 1.
  CubeMapping(Layout layout, int edge);

  [[nodiscard]] Texel texel(int row, int column) const;
  // The texels of a line's span, and the sum of their solid angles.
  double fill(const TexelLine& line, const TexelSpan& span, const TexelArrays& arrays) const;

  // First and last texel of a row or column that is on a face, as [begin, end).
  [[nodiscard]] std::array<int, 2> row_range(int row) const;
  [[nodiscard]] std::array<int, 2> column_range(int column) const;

 private:
  // `inverse` is 1/(1 + s^2 + t^2).
  [[nodiscard]] double solid_angle(int row, int column, double s, double t, double inverse) const;

  int edge_;
  int columns_;  // of blocks
  int rows_;
  FaceSampling sampling_;
  double step_;                    // from a texel to the next
  double first_;                   // place of the first
  std::vector<CubeBlock> blocks_;  // (rows, columns)
};

// Angular map and mirror ball: a disc in a square of `size` texels.
//   angular: angle from the centre pi r, so d(solid angle) = pi sin(pi r)/r dA
//   mirror ball: 2 asin(r), so d(solid angle) = 4 dA
// A texel belongs to the disc where its centre does, and then stands for its whole square; the
// squares cover the disc but for the rim, so that solid angles sum to 4 pi only nearly: the angular
// map's to O(size^-2), the mirror ball's to O(size^-3/2).
class DiscMapping {
 public:
  // Precondition: angular or mirror_ball; size >= 1.
  DiscMapping(Layout layout, int size) : is_angular_(layout == Layout::angular), size_(size) {}

  [[nodiscard]] Texel texel(int row, int column) const;
  // The texels of a line's span, and the sum of their solid angles.
  double fill(const TexelLine& line, const TexelSpan& span, const TexelArrays& arrays) const;

  // Of a row, or of a column: the disc is symmetric.
  [[nodiscard]] std::array<int, 2> range(int line) const;

 private:
  bool is_angular_;
  int size_;
};

class OctahedralMapping {
 public:
  // Precondition: octahedral or octahedral_equal_area; size >= 1.
  OctahedralMapping(Layout layout, int size)
      : is_equal_area_(layout == Layout::octahedral_equal_area), size_(size) {}

  [[nodiscard]] Texel texel(int row, int column) const;
  // The texels of a line's span, and the sum of their solid angles.
  double fill(const TexelLine& line, const TexelSpan& span, const TexelArrays& arrays) const;

 private:
  bool is_equal_area_;
  int size_;
};

}  // namespace shoal
