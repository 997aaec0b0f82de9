// Directions over the whole sphere, and a function's values there.
#pragma once

#include <glm/vec3.hpp>
#include <span>
#include <vector>

namespace shoal {

// Directions with the weights of a quadrature: their sum is 4 pi.
struct DirectionGrid {
  std::vector<glm::dvec3> directions;  // unit, native frame; row after row from the north
  std::vector<double> weights;         // sr, one a direction
};

// `rows` Gauss-Legendre nodes in cos(theta) by 2 rows columns of equal angles: integrates every
// function of degree 2 rows - 1 and below exactly, so the square of one of degree rows - 1. Bits do
// not depend on the processor. Precondition: rows >= 1.
[[nodiscard]] DirectionGrid gauss_grid(int rows);

// A function's values at the texel centres of an equirect picture of `rows` by 2 rows texels.
struct EquirectValues {
  int rows = 0;
  std::vector<double> values;  // (rows, 2 rows)
  std::vector<double> shares;  // (rows): of the sphere that one texel of the row covers

  [[nodiscard]] int columns() const { return 2 * rows; }
  // Unit, native frame.
  [[nodiscard]] glm::dvec3 direction(std::size_t index) const;
};

// `coefficients`: (degree+1)^2, index order. Bits do not depend on the processor. An extremum
// between the texels lies above or below its nearest texel by at most
//   h^2/2 sum_l l^2 max |f_l|,   h = pi / (sqrt(2) rows),
// f_l being what degree l contributes: Bernstein's inequality bounds the second derivative along a
// great circle by l^2. Precondition: rows >= 1.
[[nodiscard]] EquirectValues equirect_values(std::span<const double> coefficients, int degree,
                                             int rows);

enum class Extremum { least, greatest };

struct DirectedValue {
  double value = 0.0;
  glm::dvec3 direction{0.0, 0.0, 1.0};  // unit, native frame
};

// The grid's least or greatest value, climbed from its texel to the extremum beside it by a compass
// search (Hooke & Jeeves, "Direct Search Solution of Numerical and Statistical Problems", J. ACM 8,
// 1961) to 1e-9 of arc, so to 1e-17 of the function's size times L^2. `grid`: equirect_values() of
// the same coefficients.
[[nodiscard]] DirectedValue extremum_of(std::span<const double> coefficients, int degree,
                                        const EquirectValues& grid, Extremum which);

}  // namespace shoal
