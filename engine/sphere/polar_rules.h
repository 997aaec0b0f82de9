// Quadrature weights on equidistant polar angles:
//   integral over [0, pi] of f(theta) sin(theta) d theta  ~  sum over rows of w_i f(theta_i).
// Both are exact for f a polynomial in cos(theta) of degree <= height - 1 (height, if height is
// odd), positive, symmetric, and cost O(height).
#pragma once

#include <vector>

namespace shoal {

// Fejer's first rule, theta_i = pi (i+1/2)/height. The ceil(height/2) rows down to the equator;
// w_(height-1-i) = w_i. Precondition: height >= 1.
[[nodiscard]] std::vector<long double> fejer_weights(int height);

// Clenshaw-Curtis, theta_i = pi i/(height-1), rows as above. Precondition: height >= 2.
[[nodiscard]] std::vector<long double> clenshaw_curtis_weights(int height);

}  // namespace shoal
