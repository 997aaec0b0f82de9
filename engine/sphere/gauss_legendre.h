// Gauss-Legendre quadrature, and how many of its nodes a trigonometric polynomial needs.
#pragma once

#include <vector>

namespace shoal {

// Nodes in (-1, 1), ascending, and their weights: sum of weights = 2, exact for polynomials of
// degree 2n-1. Mirrored exactly: node[k] == -node[n-1-k], weight[k] == weight[n-1-k].
struct GaussRule {
  std::vector<long double> nodes;
  std::vector<long double> weights;
};

// Error: a few units in the last place of long double. Precondition: count >= 1.
[[nodiscard]] GaussRule gauss_legendre(int count);

// The fewest nodes that integrate every trigonometric polynomial f of degree K over an interval of
// half-width h to 2^-60 of 2 h max|f|, where phase = K h.
[[nodiscard]] int gauss_legendre_count(double phase);

}  // namespace shoal
