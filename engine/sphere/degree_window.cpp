#include "sphere/degree_window.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <string>

#include "core/diagnostic.h"

namespace shoal {
namespace {

// long double's functions are the same on every x86-64; double's depend on whether the CPU fuses.
using Real = long double;
constexpr Real kPi = std::numbers::pi_v<Real>;

constexpr std::array<std::string_view, 5> kNames = {"none", "hann", "lanczos", "gauss",
                                                    "laplacian"};
constexpr std::array<std::string_view, 5> kParameterNames = {"", "width", "width", "sigma",
                                                             "lambda"};

// l(l+1), minus which is the Laplacian's eigenvalue, at the middle h = (L+1)/2 of a sum to L.
Real middle_eigenvalue(int degree) {
  const Real middle = Real(degree + 1) / 2;
  return middle * (middle + 1);
}

Real gain(WindowKind kind, Real parameter, int l) {
  const Real eigenvalue = Real(l) * (l + 1);
  switch (kind) {
    case WindowKind::none:
      return 1;
    case WindowKind::hann: {
      // cos^2 of half the angle: (1 + cos) / 2 without its loss next to zero.
      const Real half = std::cos(kPi * l / (2 * parameter));
      return l < parameter ? half * half : 0;
    }
    case WindowKind::lanczos: {
      const Real angle = kPi * l / parameter;
      return l < parameter ? std::sin(angle) / angle : 0;
    }
    case WindowKind::gauss:
      return std::exp(-eigenvalue * parameter * parameter / 2);
    case WindowKind::laplacian:
      return 1 / (1 + parameter * eigenvalue * eigenvalue);
  }
  return 1;
}

}  // namespace

std::string_view name_of(WindowKind kind) { return kNames[static_cast<int>(kind)]; }

std::string_view parameter_name(WindowKind kind) { return kParameterNames[static_cast<int>(kind)]; }

Result<WindowKind> parse_window_kind(std::string_view name) {
  const auto found = std::find(kNames.begin(), kNames.end(), name);
  if (found != kNames.end()) return static_cast<WindowKind>(found - kNames.begin());
  const std::string_view near = closest_match(name, kNames);
  return Error{ErrorCode::usage, "unknown window \"" + std::string(name) + "\"", "",
               near.empty() ? "use none, hann, lanczos, gauss or laplacian"
                            : "did you mean \"" + std::string(near) + "\"?"};
}

Status check_window(const DegreeWindow& window) {
  if (!window.parameter) return {};
  const double parameter = *window.parameter;
  const std::string name(name_of(window.kind));
  const std::string what(parameter_name(window.kind));
  switch (window.kind) {
    case WindowKind::none:
      return Error{ErrorCode::usage, "the window \"none\" has no parameter", "",
                   "leave it out, or choose hann, lanczos, gauss or laplacian"};
    case WindowKind::hann:
    case WindowKind::lanczos:
      if (std::isfinite(parameter) && parameter > 0.0) return {};
      return Error{ErrorCode::usage, "the " + what + " of a " + name + " window is not above 0", "",
                   "give the degree from which nothing is left, such as 4"};
    case WindowKind::gauss:
    case WindowKind::laplacian:
      if (std::isfinite(parameter) && parameter >= 0.0) return {};
      return Error{ErrorCode::usage, "the " + what + " of a " + name + " window is below 0", "",
                   "give 0 for no attenuation, or leave it out for the default"};
  }
  return {};
}

double effective_parameter(const DegreeWindow& window, int degree) {
  if (window.parameter) return *window.parameter;
  switch (window.kind) {
    case WindowKind::none:
      return 0.0;
    case WindowKind::hann:
    case WindowKind::lanczos:
      return degree + 1;
    case WindowKind::gauss:
      return static_cast<double>(
          std::sqrt(2 * std::numbers::ln2_v<Real> / middle_eigenvalue(degree)));
    case WindowKind::laplacian:
      return static_cast<double>(1 / (middle_eigenvalue(degree) * middle_eigenvalue(degree)));
  }
  return 0.0;
}

std::vector<double> window_gains(const DegreeWindow& window, int degree) {
  const double parameter = effective_parameter(window, degree);
  std::vector<double> gains(degree + 1, 1.0);
  for (int l = 1; l <= degree; ++l) {
    gains[l] = static_cast<double>(gain(window.kind, parameter, l));
  }
  return gains;
}

Coefficients apply_gains(Coefficients coefficients, std::span<const double> gains) {
  for (int l = 0; l <= coefficients.degree; ++l) {
    for (auto& channel : coefficients.channels) {
      for (int i = l * l; i < (l + 1) * (l + 1); ++i) channel[i] *= gains[l];
    }
  }
  return coefficients;
}

}  // namespace shoal
