// Where in a picture a direction lies: the mappings of sphere/texel_mappings.h turned round.
#pragma once

#include <glm/vec3.hpp>
#include <vector>

#include "sphere/layout.h"
#include "sphere/texel_mappings.h"

namespace shoal {

// A place in one of the squares of which a picture is made: a cube's blocks, each a face, or the
// whole of another one.
struct LayoutPlace {
  int block_row = 0;
  int block_column = 0;
  double right = 0.0;  // in [0, 1], from the square's left edge to its right one
  double down = 0.0;   // from the upper one to the lower one
};

class LayoutPlaces {
 public:
  // Precondition: a layout other than automatic and equirect.
  explicit LayoutPlaces(Layout layout);

  // To 1e-15 of the square, where a texel does not stand for much more: an octahedron's corners, a
  // disc's rim. A direction between faces or folds is given to one of them; the one behind a disc
  // to a point of its rim. The direction is a unit vector of the native frame.
  [[nodiscard]] LayoutPlace of(const glm::dvec3& direction) const;

 private:
  [[nodiscard]] LayoutPlace on_cube(const glm::dvec3& direction) const;
  [[nodiscard]] LayoutPlace on_disc(const glm::dvec3& direction) const;
  [[nodiscard]] LayoutPlace on_octahedron(const glm::dvec3& direction) const;

  Layout layout_;
  int block_columns_;
  std::vector<CubeBlock> blocks_;  // of a cube
};

}  // namespace shoal
