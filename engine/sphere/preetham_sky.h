// The light of a cloudless sky and its sun: Preetham, Shirley, Smits, "A Practical Analytic Model
// for Daylight", SIGGRAPH 1999.
//
// Units: luminance in kcd/m^2, irradiance as illuminance in klx (kcd sr/m^2), both as linear
// Rec.709 red, green and blue whose luminance (sphere/linear_operations.h) they are. White is D65.
//
// The sky's colour is fitted (appendix A.2) to a simulation of turbidities 2 to 6 and carries on to
// 10. Within 2 .. 10 and with the sun above the horizon it is positive and, but for a trace of blue
// under a setting sun at turbidity 2, inside Rec.709. Outside the fit breaks: below a turbidity of
// about 1.7 the sky becomes negative, below 1.2 infinite at the horizon; with the sun below the
// horizon zenith luminance goes negative. Within, too, it has known faults (Zotti, Wilkie,
// Purgathofer, "A Critical Review of the Preetham Skylight Model", WSCG 2007): at a turbidity near
// 2 the horizon is far too bright, most of all under a low sun. 3 to 6 are its sound middle.
#pragma once

#include <array>
#include <glm/vec3.hpp>

#include "core/result.h"
#include "sphere/analytic_lights.h"

namespace shoal {

struct PreethamSky {
  double turbidity = 3.0;         // haze: 2 very clear, 10 hazy
  double sun_elevation = 45.0;    // degrees of arc above the horizon, 0 .. 90
  double sun_azimuth = 0.0;       // degrees to the right of the panorama's centre
  glm::dvec3 ground_albedo{0.2};  // 0 .. 1, linear Rec.709

  friend bool operator==(const PreethamSky&, const PreethamSky&) = default;
};

inline constexpr double kMinTurbidity = 2.0;
inline constexpr double kMaxTurbidity = 10.0;
inline constexpr double kSunAngularRadius = 0.2665;  // degrees of arc, at the mean distance

// Error: usage, for what is outside of the ranges above.
[[nodiscard]] Status check_sky(const PreethamSky& sky);

// CIE x, y and luminance Y in kcd/m^2.
struct SkyColour {
  double x = 0.0;
  double y = 0.0;
  double luminance = 0.0;
};

// The sky of one turbidity and sun, in the native frame. Directions are unit vectors.
// Thread-safe once made.
class PreethamModel {
 public:
  // Precondition: check_sky.
  explicit PreethamModel(const PreethamSky& sky);

  // The sky without the sun and without ground. Precondition: direction.z >= 0.
  [[nodiscard]] SkyColour colour(const glm::dvec3& direction) const;

  // The same as Rec.709; below the horizon the ground, the same in all directions. Never negative.
  [[nodiscard]] glm::dvec3 radiance(const glm::dvec3& direction) const;

  // What a horizontal surface gets of the sky alone: the integral of its radiance times cos(theta),
  // to 1e-4.
  [[nodiscard]] const glm::dvec3& sky_irradiance() const { return sky_irradiance_; }

  // What a surface that faces the sun gets of the sun.
  [[nodiscard]] const glm::dvec3& sun_irradiance() const { return sun_irradiance_; }

  // Albedo times the irradiance of sky and sun over pi.
  [[nodiscard]] const glm::dvec3& ground_radiance() const { return ground_radiance_; }

  // A uniform disk of kSunAngularRadius with the irradiance sun_irradiance() of a facing surface.
  [[nodiscard]] DiskLight sun() const;

 private:
  // Perez' five coefficients: F(theta, gamma) = (1 + A exp(B/cos theta)) (1 + C exp(D gamma) + E
  // cos^2 gamma), and what it is multiplied by: the zenith's value over F(0, theta_sun).
  struct Distribution {
    std::array<double, 5> perez{};
    double factor = 0.0;

    [[nodiscard]] double relative(double cos_theta, double gamma, double cos_gamma) const;
  };

  [[nodiscard]] glm::dvec3 above_horizon(const glm::dvec3& direction) const;

  glm::dvec3 to_sun_;
  Distribution luminance_;
  Distribution x_;
  Distribution y_;
  glm::dvec3 sun_irradiance_;
  glm::dvec3 sky_irradiance_;
  glm::dvec3 ground_radiance_;
};

// How many times the air above one the sun's light goes through: relative optical mass (Kasten
// 1966, as Iqbal has it), 1 at the zenith, 37 at the horizon.
[[nodiscard]] double air_mass(double sun_elevation);

// The direct sun on a facing surface, through so much air: the spectrum outside the atmosphere
// through Rayleigh scattering, aerosols by Angstrom's formula and ozone (the paper's appendix A.1,
// after Iqbal, "An Introduction to Solar Radiation", 1983), and the colour-matching functions of
// Wyman, Sloan, Shirley (JCGT 2(2), 2013). Mixed gases and water vapour absorb from 690 nm on only,
// where the eye sees less than 1 %: left out. What is outside Rec.709, as of the reddest suns, is
// cut off at 0. Precondition: air_mass >= 0; a turbidity in range.
[[nodiscard]] glm::dvec3 sunlight(double turbidity, double air_mass);

// The unit vector to the sun, native frame.
[[nodiscard]] glm::dvec3 sun_direction(const PreethamSky& sky);

}  // namespace shoal
