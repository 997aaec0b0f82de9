#include "scenes/colours.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/exponential.hpp>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <span>

#include "library/light.h"

namespace shoal::viz {
namespace {

struct OkLab {
  double lightness;
  double a;  // green to red
  double b;  // blue to yellow
};

glm::dvec3 linear_of(const OkLab& lab) {
  const double l = lab.lightness + 0.3963377774 * lab.a + 0.2158037573 * lab.b;
  const double m = lab.lightness - 0.1055613458 * lab.a - 0.0638541728 * lab.b;
  const double s = lab.lightness - 0.0894841775 * lab.a - 1.2914855480 * lab.b;
  const glm::dvec3 cones(l * l * l, m * m * m, s * s * s);
  return {glm::dot(cones, {4.0767416621, -3.3077115913, 0.2309699292}),
          glm::dot(cones, {-1.2684380046, 2.6097574011, -0.3413193965}),
          glm::dot(cones, {-0.0041960863, -0.7034186147, 1.7076147010})};
}

OkLab mix(const OkLab& from, const OkLab& to, double t) {
  return {std::lerp(from.lightness, to.lightness, t), std::lerp(from.a, to.a, t),
          std::lerp(from.b, to.b, t)};
}

// Anchors at equal steps of t in [0, 1].
glm::vec3 along(std::span<const OkLab> anchors, double t) {
  if (std::isnan(t)) return {};
  const double place = std::clamp(t, 0.0, 1.0) * static_cast<double>(anchors.size() - 1);
  const auto below = std::min(static_cast<std::size_t>(place), anchors.size() - 2);
  return srgb_encoded(
      linear_of(mix(anchors[below], anchors[below + 1], place - static_cast<double>(below))));
}

constexpr OkLab kDiverging[] = {
    {0.42, -0.025, -0.155}, {0.66, -0.045, -0.095}, {0.94, 0.0, 0.004},
    {0.66, 0.070, 0.105},   {0.42, 0.075, 0.085},
};

constexpr OkLab kSequential[] = {
    {0.17, 0.030, -0.060}, {0.36, 0.035, -0.125}, {0.54, -0.060, -0.065},
    {0.72, -0.125, 0.045}, {0.95, -0.045, 0.150},
};

double shoulder(double x) {
  constexpr double kKnee = 0.7;
  if (x <= kKnee) return x;
  return kKnee + (1.0 - kKnee) * (1.0 - std::exp(-(x - kKnee) / (1.0 - kKnee)));
}

}  // namespace

glm::vec3 diverging_colour(double t) { return along(kDiverging, 0.5 + 0.5 * t); }

glm::vec3 sequential_colour(double t) { return along(kSequential, t); }

glm::vec3 srgb_encoded(const glm::dvec3& linear) {
  return {srgb_encoded(linear.r), srgb_encoded(linear.g), srgb_encoded(linear.b)};
}

glm::vec3 tone_mapped(const glm::dvec3& light, double exposure) {
  glm::dvec3 toned;
  for (int c = 0; c < 3; ++c) {
    if (!std::isfinite(light[c])) return {1.0f, 0.0f, 1.0f};
    toned[c] = shoulder(std::max(0.0, light[c] * exposure));
  }
  return srgb_encoded(toned);
}

glm::vec3 pure_colour(const glm::dvec3& light) {
  const glm::dvec3 there = glm::max(light, glm::dvec3(0.0));
  const double largest = std::max({there.r, there.g, there.b});
  return largest > 0.0 ? srgb_encoded(there / largest) : glm::vec3(0.25f);
}

double lightness(const glm::vec3& srgb) {
  const glm::dvec3 linear(srgb_decoded(srgb.r), srgb_decoded(srgb.g), srgb_decoded(srgb.b));
  const glm::dvec3 cones(glm::dot(linear, {0.4122214708, 0.5363325363, 0.0514459929}),
                         glm::dot(linear, {0.2119034982, 0.6806995451, 0.1073969566}),
                         glm::dot(linear, {0.0883024619, 0.2817188376, 0.6299787005}));
  const glm::dvec3 roots(std::cbrt(cones.x), std::cbrt(cones.y), std::cbrt(cones.z));
  return glm::dot(roots, {0.2104542553, 0.7936177850, -0.0040720468});
}

}  // namespace shoal::viz
