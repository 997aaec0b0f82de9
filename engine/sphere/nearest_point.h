// The point of a polyhedron that is nearest to the origin.
#pragma once

#include <optional>
#include <span>
#include <vector>

namespace shoal {

// One condition, sum of normal[k] x_k >= bound.
struct HalfSpace {
  std::vector<double> normal;
  double bound = 0.0;
};

// The x of least length that meets every condition, or nothing where none does or rounding keeps
// the search from settling. Unique, since the square of a length is strictly convex. Conditions are
// met to 1e-15 of their normal's length times (1 + |x|); x and the bounds should be of order 1.
//
// "Least distance programming", brought to non-negative least squares: Lawson & Hanson, "Solving
// Least Squares Problems", 1974, ch. 23, algorithms LDP and NNLS. Cost: dimension^3 a condition
// that binds. Precondition: every normal holds `dimension` numbers.
[[nodiscard]] std::optional<std::vector<double>> nearest_point(
    int dimension, std::span<const HalfSpace> conditions);

}  // namespace shoal
