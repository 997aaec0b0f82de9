#include "sphere/analytic_lights.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>
#include <string>
#include <utility>

#include "sphere/basis.h"
#include "sphere/irradiance.h"

namespace shoal {
namespace {

constexpr double kPi = std::numbers::pi;

template <typename... Visitors>
struct Overloaded : Visitors... {
  using Visitors::operator()...;
};
template <typename... Visitors>
Overloaded(Visitors...) -> Overloaded<Visitors...>;  // for Clang before 17

bool all_finite(const glm::dvec3& v) {
  return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

// Scaled by the largest component first, so that neither tiny nor huge ones are lost in squares.
glm::dvec3 unit(const glm::dvec3& direction) {
  const double largest =
      std::max({std::abs(direction.x), std::abs(direction.y), std::abs(direction.z)});
  return glm::normalize(direction / largest);
}

Status check_direction(const glm::dvec3& direction) {
  if (all_finite(direction) && direction != glm::dvec3(0.0)) return {};
  return Error{ErrorCode::usage, "a light's direction is zero or not finite", "",
               "give the vector that points to the light, such as [0, 0, 1]"};
}

Status check_colour(const glm::dvec3& colour, const char* what) {
  if (all_finite(colour)) return {};
  return Error{ErrorCode::usage, std::string("a light's ") + what + " is not finite", "",
               "give three numbers, linear R, G and B"};
}

Status check_radius(double radius) {
  if (radius > 0.0 && radius <= kPi) return {};
  return Error{ErrorCode::usage,
               "a disk's angular radius is not above 0 and at most 180 degrees of arc", "",
               "90 degrees make a hemisphere; for a light without extent use a directional one"};
}

// Radiance or, for a directional light, irradiance.
glm::dvec3 colour_of(const AnalyticLight& light) {
  return std::visit(Overloaded{[](const DirectionalLight& l) { return l.irradiance; },
                               [](const auto& l) { return l.radiance; }},
                    light);
}

// The ambient light is the same about every axis.
glm::dvec3 axis_of(const AnalyticLight& light) {
  return std::visit(Overloaded{[](const AmbientLight&) { return glm::dvec3(0.0, 0.0, 1.0); },
                               [](const auto& l) { return unit(l.direction); }},
                    light);
}

}  // namespace

Status check_light(const AnalyticLight& light) {
  const auto check = Overloaded{
      [](const AmbientLight& l) { return check_colour(l.radiance, "radiance"); },
      [](const DirectionalLight& l) -> Status {
        SHOAL_RETURN_IF_ERROR(check_direction(l.direction));
        return check_colour(l.irradiance, "irradiance");
      },
      [](const DiskLight& l) -> Status {
        SHOAL_RETURN_IF_ERROR(check_direction(l.direction));
        SHOAL_RETURN_IF_ERROR(check_radius(l.angular_radius));
        return check_colour(l.radiance, "radiance");
      },
      [](const CosineLobe& l) -> Status {
        SHOAL_RETURN_IF_ERROR(check_direction(l.direction));
        return check_colour(l.radiance, "radiance");
      },
  };
  return std::visit(check, light);
}

std::vector<double> cap_zonal_factors(double angular_radius, int degree) {
  // P_l' = C_(l-1)^(3/2), the Gegenbauer polynomials, by their three-term recurrence
  //   l P'_(l+1) = (2l+1) x P'_l - (l+1) P'_(l-1).
  // In long double its rounding, at most l^2 units, and that of cos(a), which P_l' feels l^2/4
  // times, stay below a double's last place.
  using Real = long double;
  const Real radius = angular_radius;
  const Real x = std::cos(radius);
  const Real sine = std::sin(radius);
  const Real half_sine = std::sin(radius / 2);
  const Real two_pi = 2 * std::numbers::pi_v<Real>;

  std::vector<double> factors(degree + 1);
  factors[0] = static_cast<double>(2 * two_pi * half_sine * half_sine);  // 1 - cos a, no loss
  Real below = 0;
  Real derivative = 1;  // P_1'
  for (int l = 1; l <= degree; ++l) {
    factors[l] = static_cast<double>(two_pi * sine * sine * derivative / (Real(l) * (l + 1)));
    const Real next = ((2 * l + 1) * x * derivative - (l + 1) * below) / l;
    below = std::exchange(derivative, next);
  }
  return factors;
}

std::vector<double> zonal_factors(const AnalyticLight& light, int degree) {
  const auto factors = Overloaded{
      [&](const AmbientLight&) {
        std::vector<double> only_mean(degree + 1, 0.0);
        only_mean[0] = 4 * kPi;
        return only_mean;
      },
      [&](const DirectionalLight&) { return std::vector<double>(degree + 1, 1.0); },
      [&](const DiskLight& l) { return cap_zonal_factors(l.angular_radius, degree); },
      [&](const CosineLobe&) {
        std::vector<double> gains(degree + 1);
        for (int l = 0; l <= degree; ++l) gains[l] = clamped_cosine_gain(l);
        return gains;
      },
  };
  return std::visit(factors, light);
}

Coefficients project_lights(std::span<const AnalyticLight> lights, int degree) {
  Coefficients sum(degree);
  const Basis<double> basis(degree);
  std::vector<double> y(coefficient_count(degree));
  for (const AnalyticLight& light : lights) {
    const std::vector<double> factors = zonal_factors(light, degree);
    const glm::dvec3 colour = colour_of(light);
    basis.evaluate(axis_of(light), y);
    for (int l = 0; l <= degree; ++l) {
      for (int i = l * l; i < (l + 1) * (l + 1); ++i) {
        const double unit_light = factors[l] * y[i];
        for (int c = 0; c < kChannelCount; ++c) sum.channels[c][i] += unit_light * colour[c];
      }
    }
  }
  return sum;
}

AnalyticLight turned(AnalyticLight light, const glm::dmat3& orthogonal) {
  std::visit(
      Overloaded{[](AmbientLight&) {}, [&](auto& l) { l.direction = orthogonal * l.direction; }},
      light);
  return light;
}

std::optional<PaintableLight> paintable(const AnalyticLight& light) {
  using Painted = std::optional<PaintableLight>;
  return std::visit(Overloaded{[](const DirectionalLight&) -> Painted { return std::nullopt; },
                               [](const auto& l) -> Painted { return l; }},
                    light);
}

glm::dvec3 radiance_at(const PaintableLight& light, const glm::dvec3& direction) {
  const auto radiance = Overloaded{
      [](const AmbientLight& l) { return l.radiance; },
      [&](const DiskLight& l) {
        // The arc tangent tells small angles and angles next to pi apart; the cosine does not.
        const glm::dvec3 axis = unit(l.direction);
        const long double angle =
            std::atan2(static_cast<long double>(glm::length(glm::cross(axis, direction))),
                       static_cast<long double>(glm::dot(axis, direction)));
        return static_cast<double>(angle) <= l.angular_radius ? l.radiance : glm::dvec3(0.0);
      },
      [&](const CosineLobe& l) {
        return l.radiance * std::max(0.0, glm::dot(unit(l.direction), direction));
      },
  };
  return std::visit(radiance, light);
}

}  // namespace shoal
