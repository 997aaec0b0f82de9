// Windows over degrees: gains g_l that fade a sum of spherical harmonics out instead of cutting it
// off, so that it ripples less and dips less below zero ("deringing").
//
// Source of the named windows: Sloan, "Stupid Spherical Harmonics (SH) Tricks", GDC 2008,
// "Windowing" and "Ringing"; the Gaussian as noted there.
#pragma once

#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "core/result.h"
#include "sphere/coefficients.h"

namespace shoal {

// g_0 = 1 for all of them: the mean stays. L is the coefficients' degree, h = (L+1)/2 the middle of
// what a sum to degree L holds. Defaults make the kinds alike, so that one may be tried for
// another.
enum class WindowKind {
  none,     // g_l = 1; no parameter
  hann,     // (1 + cos(pi l/w)) / 2, zero from l = w on. w > 0, default L+1: the first degree that
            // is missing anyway is the first that is gone; g = 1/2 at h
  lanczos,  // sin(pi l/w) / (pi l/w), zero from l = w on. w > 0, default L+1: Lanczos' sigma
            // factors; milder than hann, g = 2/pi at h
  gauss,    // exp(-l(l+1) s^2/2): blur by the heat kernel on the sphere, s its standard deviation
            // along either tangent, in radians. s >= 0, default such that g = 1/2 at h. Being a
            // kernel that is nowhere negative, it never makes a light negative by itself (White &
            // Srednicki, "Window functions of cosmic microwave background experiments", ApJ 443
            // (1995), sec. 2)
  laplacian,  // 1 / (1 + k l^2 (l+1)^2): least square error plus k times the squared Laplacian.
              // k >= 0, default such that g = 1/2 at h
};

struct DegreeWindow {
  WindowKind kind = WindowKind::none;
  std::optional<double> parameter{};  // w, w, s, k as above; nothing for the default

  friend bool operator==(const DegreeWindow&, const DegreeWindow&) = default;
};

// "none", "hann", "lanczos", "gauss", "laplacian".
[[nodiscard]] std::string_view name_of(WindowKind kind);

// What the kind's parameter is called: "width", "width", "sigma", "lambda", and "" for none.
[[nodiscard]] std::string_view parameter_name(WindowKind kind);

// The kind of such a name. Error: usage, with the nearest name.
[[nodiscard]] Result<WindowKind> parse_window_kind(std::string_view name);

// Errors: usage, for a parameter that is not finite or out of the range above, or for any parameter
// of `none`.
[[nodiscard]] Status check_window(const DegreeWindow& window);

// The parameter that is used at a degree: the window's own or the default; 0 for none.
[[nodiscard]] double effective_parameter(const DegreeWindow& window, int degree);

// g_0 .. g_degree, each in [0, 1] (lanczos to its first zero only), to 1e-15. Preconditions:
// check_window, degree >= 0.
[[nodiscard]] std::vector<double> window_gains(const DegreeWindow& window, int degree);

// Every coefficient of degree l times gains[l], whatever linear quantity they are of. A gain of 1
// leaves the bits as they are. Precondition: gains holds at least the coefficients' degree + 1.
[[nodiscard]] Coefficients apply_gains(Coefficients coefficients, std::span<const double> gains);

}  // namespace shoal
