// Every convention of shoal's spherical harmonics, in one place. Others refer here, never restate.
//
// Basis       real, orthonormal over the unit sphere, without the Condon-Shortley phase:
//               Y_lm = Pbar_lm(cos theta) cos(m phi)      m >= 0
//               Y_lm = Pbar_l|m|(cos theta) sin(|m| phi)  m < 0
//             Pbar_lm > 0 next to the north pole and holds the normalisation, the sqrt(2) of m != 0
//             included: the integral of Y_lm^2 is 1. For l <= 2 these are exactly the polynomials
//             of Ramamoorthi & Hanrahan, "An Efficient Representation for Irradiance Environment
//             Maps", SIGGRAPH 2001, eq. 3.
// Index       i = l(l+1) + m, l = 0..L, m = -l..l.
// Frame       native: (x, y, z) = (sin theta cos phi, sin theta sin phi, cos theta), where theta
//             grows from the top row of an equirect picture, phi from its left edge to the right.
//             So the picture's centre is -x, a quarter turn to the right of it is -y, up is +z.
// Radiance    L_lm = integral of L(w) Y_lm(w) dw. No 1/(4 pi): a constant environment of radiance 1
//             has L_00 = sqrt(4 pi).
// Irradiance  E_lm = A_l L_lm, A_l of the clamped cosine: pi, 2pi/3, pi/4, 0, -pi/24, 0, pi/64 ...
//             A constant environment of radiance 1 has irradiance pi everywhere.
#pragma once

namespace shoal {

// Degrees from 0 to this are supported everywhere and tested.
inline constexpr int kMaxDegree = 64;

// (L+1)^2, the number of coefficients to degree L.
[[nodiscard]] constexpr int coefficient_count(int degree) { return (degree + 1) * (degree + 1); }

// The index of (l, m), |m| <= l.
[[nodiscard]] constexpr int coefficient_index(int l, int m) { return l * (l + 1) + m; }

}  // namespace shoal
