// What colour light has, whatever its strength: how warm it is, and how far it is from another.
#pragma once

#include <glm/vec3.hpp>
#include <optional>

namespace shoal {

// The temperature in kelvin of the black body whose colour is nearest to a linear Rec.709 colour,
// nearest being meant in the CIE 1960 (u, v) diagram: 6504 for equal R, G and B, the white D65;
// less is warmer. Nothing for a colour of which that would say nothing: without light, with a
// negative X, Y or Z, farther than kMostOffLocus from the black bodies' locus, or beyond the
// method's range of 1667 K to 100,000 K. Error along the locus: below 0.8 MK^-1 (10^6/kelvin), 13 K
// at 4000 K, from 1800 K to 15,000 K. Source: Robertson, "Computation of Correlated Color
// Temperature and Distribution Temperature", J. Opt. Soc. Am. 58 (1968) 1528, with the table of
// Wyszecki & Stiles, "Color Science", 2nd ed. (1982), table 1(3.11), whose u at 325 MK^-1 is a
// misprint of 0.24792.
[[nodiscard]] std::optional<double> correlated_colour_temperature(const glm::dvec3& rgb);

// In (u, v). CIE 15:2018: beyond it the notion should not be used.
inline constexpr double kMostOffLocus = 0.05;

// The distance of two linear Rec.709 colours in the CIE 1976 uniform chromaticity diagram,
// u' = 4X/(X+15Y+3Z), v' = 9Y/(X+15Y+3Z) (CIE 15:2018, 8.1), in which 0.004 or so is just seen;
// 0 where one of them has no chromaticity: no light, or a negative X, Y or Z.
[[nodiscard]] double colour_distance(const glm::dvec3& a, const glm::dvec3& b);

}  // namespace shoal
