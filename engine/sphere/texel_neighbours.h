// Which texels of a picture touch one another on the sphere.
#pragma once

#include <optional>
#include <vector>

#include "sphere/layout.h"
#include "sphere/layout_places.h"
#include "sphere/texel_mappings.h"

namespace shoal {

struct TexelIndex {
  int row = 0;
  int column = 0;

  friend bool operator==(const TexelIndex&, const TexelIndex&) = default;
};

// Texels touch with their sides or corners, in the picture and where its edges meet on the sphere:
// over the seam of an equirect picture, over the edges of a cube's faces, over the edges of an
// octahedral map.
class TexelNeighbours {
 public:
  // Precondition: a picture that the layout, other than automatic, can have.
  TexelNeighbours(Layout layout, int width, int height);

  // The texels that touch this one, at most nine, some perhaps more than once, or itself; outside
  // of a disc there may be some that show nothing.
  [[nodiscard]] std::vector<TexelIndex> of(const TexelIndex& texel) const;

  // All texels with the same number touch in one direction: those of the first row and of the last
  // in the poles, those on the rim of a disc in the direction behind. 0: it is none of these.
  [[nodiscard]] int common_point(const TexelIndex& texel) const;

 private:
  [[nodiscard]] std::optional<TexelIndex> neighbour(int row, int column, int down, int right) const;
  [[nodiscard]] TexelIndex on_cube(int row, int column, int down, int right) const;
  [[nodiscard]] TexelIndex on_octahedron(int row, int column) const;
  [[nodiscard]] bool is_on_disc(int row, int column) const;
  [[nodiscard]] double place_on_face(int index) const;
  [[nodiscard]] int index_on_face(double place) const;

  Layout layout_;
  int width_;
  int height_;
  int edge_ = 0;                        // of a cube's face
  std::vector<CubeBlock> blocks_;       // of a cube
  std::optional<LayoutPlaces> places_;  // of a cube
};

}  // namespace shoal
