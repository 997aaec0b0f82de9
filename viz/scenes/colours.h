// The colours of shoal-viz: its theme, its colour maps, and how light becomes a picture.
//
// Colours on the screen are sRGB-encoded, 0 to 1 a channel; light is linear Rec.709. Maps are
// straight lines in OKLab (Ottosson, "A perceptual color space for image processing", 2020), where
// equal steps look equal, so that they are as ordered to the eye as the numbers are.
#pragma once

#include <glm/vec3.hpp>

namespace shoal::viz {

namespace theme {
inline constexpr glm::vec3 kBackground{0.086f, 0.094f, 0.114f};
inline constexpr glm::vec3 kPanel{0.122f, 0.133f, 0.161f};  // cards on the background
inline constexpr glm::vec3 kText{0.925f, 0.925f, 0.905f};
inline constexpr glm::vec3 kDimText{0.667f, 0.686f, 0.722f};  // captions; 7:1 on the background
inline constexpr glm::vec3 kLine{0.345f, 0.369f, 0.420f};     // grids, frames, the scale sphere
inline constexpr glm::vec3 kAxis{0.733f, 0.749f, 0.780f};
inline constexpr glm::vec3 kPositive{0.937f, 0.561f, 0.235f};  // orange
inline constexpr glm::vec3 kNegative{0.271f, 0.545f, 0.894f};  // blue
inline constexpr glm::vec3 kAccent{0.98f, 0.82f, 0.36f};       // arrows, the chosen cell
inline constexpr glm::vec3 kBar{0.42f, 0.70f, 0.66f};          // bars of a chart
}  // namespace theme

// From -1, blue, through a neutral light grey to 1, orange. Both ends are equally dark, and
// lightness falls strictly from the middle to either end. t is clamped; not a number is black.
[[nodiscard]] glm::vec3 diverging_colour(double t);

// From 0, nearly black violet, through blue-green to 1, pale yellow. Lightness grows strictly.
// t is clamped; not a number is black.
[[nodiscard]] glm::vec3 sequential_colour(double t);

// The sRGB curve of a linear colour, clamped to 0..1.
[[nodiscard]] glm::vec3 srgb_encoded(const glm::dvec3& linear);

// A picture of light: exposure, then a curve that is the identity up to 0.7 and bends from there
// towards 1 without ever reaching it, channel by channel so that what is too bright fades to white,
// then sRGB. Negative light is black; what is not finite is magenta, so that nobody overlooks it.
[[nodiscard]] glm::vec3 tone_mapped(const glm::dvec3& light, double exposure);

// The colour of light at full brightness: the largest channel is 1. Dark grey where there is none.
[[nodiscard]] glm::vec3 pure_colour(const glm::dvec3& light);

// OKLab's lightness of a colour on the screen, 0 to 1.
[[nodiscard]] double lightness(const glm::vec3& srgb);

}  // namespace shoal::viz
