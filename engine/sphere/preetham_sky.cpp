#include "sphere/preetham_sky.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>
#include <glm/trigonometric.hpp>
#include <numbers>

#include "sphere/gauss_legendre.h"

namespace shoal {
namespace {

constexpr double kPi = std::numbers::pi;

// CIE XYZ of linear Rec.709 with its white D65 (IEC 61966-2-1), by columns.
const glm::dmat3 kXyzOfRec709(0.4124, 0.2126, 0.0193, 0.3576, 0.7152, 0.1192, 0.1805, 0.0722,
                              0.9505);
const glm::dmat3 kRec709OfXyz = glm::inverse(kXyzOfRec709);

glm::dvec3 rec709_of(const glm::dvec3& xyz) {
  return glm::max(kRec709OfXyz * xyz, glm::dvec3(0.0));
}

// Slope and intercept over turbidity of Perez' A, B, C, D, E (appendix A.2).
using Fit = std::array<std::array<double, 2>, 5>;
constexpr Fit kLuminanceFit = {{{0.1787, -1.4630},
                                {-0.3554, 0.4275},
                                {-0.0227, 5.3251},
                                {0.1206, -2.5771},
                                {-0.0670, 0.3703}}};
constexpr Fit kXFit = {{{-0.0193, -0.2592},
                        {-0.0665, 0.0008},
                        {-0.0004, 0.2125},
                        {-0.0641, -0.8989},
                        {-0.0033, 0.0452}}};
constexpr Fit kYFit = {{{-0.0167, -0.2608},
                        {-0.0950, 0.0092},
                        {-0.0079, 0.2102},
                        {-0.0441, -1.6537},
                        {-0.0109, 0.0529}}};

// Chromaticity of the zenith: rows T^2, T, 1; columns theta^3, theta^2, theta, 1 of the sun.
using ZenithFit = std::array<std::array<double, 4>, 3>;
constexpr ZenithFit kZenithX = {{{0.00166, -0.00375, 0.00209, 0.0},
                                 {-0.02903, 0.06377, -0.03202, 0.00394},
                                 {0.11693, -0.21196, 0.06052, 0.25886}}};
constexpr ZenithFit kZenithY = {{{0.00275, -0.00610, 0.00317, 0.0},
                                 {-0.04214, 0.08970, -0.04153, 0.00516},
                                 {0.15346, -0.26756, 0.06670, 0.26688}}};

std::array<double, 5> perez_of(const Fit& fit, double turbidity) {
  std::array<double, 5> perez;
  for (std::size_t i = 0; i < perez.size(); ++i) perez[i] = fit[i][0] * turbidity + fit[i][1];
  return perez;
}

double zenith_chromaticity(const ZenithFit& fit, double turbidity, double sun_theta) {
  double sum = 0.0;
  for (const auto& row : fit) {
    const double cubic = ((row[0] * sun_theta + row[1]) * sun_theta + row[2]) * sun_theta + row[3];
    sum = sum * turbidity + cubic;
  }
  return sum;
}

double zenith_luminance(double turbidity, double sun_theta) {
  const double chi = (4.0 / 9.0 - turbidity / 120.0) * (kPi - 2.0 * sun_theta);
  return (4.0453 * turbidity - 4.9710) * std::tan(chi) - 0.2155 * turbidity + 2.4192;
}

double sun_theta_of(const PreethamSky& sky) { return glm::radians(90.0 - sky.sun_elevation); }

// The irradiance of a horizontal surface: Gauss-Legendre in cos(theta), equidistant azimuths. The
// kink at the sun limits what more nodes would bring.
template <typename Radiance>
glm::dvec3 horizontal_irradiance(const Radiance& radiance) {
  const GaussRule rule = gauss_legendre(48);
  constexpr int kAzimuths = 128;
  glm::dvec3 sum(0.0);
  for (std::size_t k = 0; k < rule.nodes.size(); ++k) {
    const double cosine = (1.0 + static_cast<double>(rule.nodes[k])) / 2.0;
    const double sine = std::sqrt(1.0 - cosine * cosine);
    const double weight = static_cast<double>(rule.weights[k]) / 2.0 * cosine;
    for (int j = 0; j < kAzimuths; ++j) {
      const double phi = 2.0 * kPi * (j + 0.5) / kAzimuths;
      sum += weight * radiance(glm::dvec3(sine * std::cos(phi), sine * std::sin(phi), cosine));
    }
  }
  return sum * (2.0 * kPi / kAzimuths);
}

// 380, 390 .. 750 nm: the sun's radiance outside the atmosphere in W m^-2 nm^-1 sr^-1, and the
// absorption of ozone in cm^-1 (the paper's tables, the latter after Iqbal 1983).
constexpr int kSpectrumCount = 38;
constexpr double kSpectrumStep = 10.0;
constexpr std::array<double, kSpectrumCount> kSunRadiance = {
    16559, 16234, 21128, 25888, 25829, 24232, 26761, 29658, 30545, 30058, 30664, 28830, 28712,
    27825, 27101, 27234, 26361, 25504, 25060, 25312, 25356, 25134, 24632, 24173, 23685, 23212,
    22828, 22340, 21970, 21527, 21098, 20728, 20240, 19871, 19427, 19072, 18629, 18259};
constexpr std::array<double, kSpectrumCount> kOzone = {
    0,     0,     0,     0,     0,     0,     0.003, 0.003, 0.006, 0.009, 0.014, 0.021, 0.030,
    0.040, 0.048, 0.063, 0.075, 0.085, 0.103, 0.120, 0.120, 0.115, 0.125, 0.120, 0.105, 0.090,
    0.079, 0.067, 0.057, 0.048, 0.036, 0.028, 0.023, 0.018, 0.014, 0.011, 0.010, 0.009};
constexpr double kOzoneColumn = 0.35;  // cm at normal pressure

// A Gaussian with one width on each side.
double bump(double nm, double center, double below, double above) {
  const double z = (nm - center) / (nm < center ? below : above);
  return std::exp(-0.5 * z * z);
}

// The CIE 1931 colour-matching functions: the multi-lobe fit of Wyman, Sloan, Shirley 2013, eq. 4.
glm::dvec3 matching_functions(double nm) {
  return {1.056 * bump(nm, 599.8, 37.9, 31.0) + 0.362 * bump(nm, 442.0, 16.0, 26.7) -
              0.065 * bump(nm, 501.1, 20.4, 26.2),
          0.821 * bump(nm, 568.8, 46.9, 40.5) + 0.286 * bump(nm, 530.9, 16.3, 31.1),
          1.217 * bump(nm, 437.0, 11.8, 36.0) + 0.681 * bump(nm, 459.0, 26.0, 13.8)};
}

// How much of the sun's light of a wavelength in micrometres comes through `mass` atmospheres.
double transmittance(double micrometres, double ozone, double mass, double turbidity) {
  const double beta = 0.04608 * turbidity - 0.04586;
  const double rayleigh = 0.008735 * std::pow(micrometres, -4.08);
  const double aerosol = beta * std::pow(micrometres, -1.3);
  return std::exp(-mass * (rayleigh + aerosol + ozone * kOzoneColumn));
}

// The integral of the cosine to its centre over the sun: what radiance is multiplied by for a
// facing surface.
const double kSunExtent = [] {
  const double sine = std::sin(glm::radians(kSunAngularRadius));
  return kPi * sine * sine;
}();

}  // namespace

Status check_sky(const PreethamSky& sky) {
  if (!(sky.turbidity >= kMinTurbidity && sky.turbidity <= kMaxTurbidity)) {
    return Error{ErrorCode::usage, "a sky's turbidity is not from 2 to 10", "",
                 "2 is very clear, 3 clear, 10 hazy"};
  }
  if (!(sky.sun_elevation >= 0.0 && sky.sun_elevation <= 90.0)) {
    return Error{ErrorCode::usage, "the sun's elevation is not from 0 to 90 degrees", "",
                 "the model has no sky for a sun below the horizon"};
  }
  if (!std::isfinite(sky.sun_azimuth)) {
    return Error{ErrorCode::usage, "the sun's azimuth is not finite", "",
                 "degrees to the right of the panorama's centre"};
  }
  for (int c = 0; c < 3; ++c) {
    if (sky.ground_albedo[c] >= 0.0 && sky.ground_albedo[c] <= 1.0) continue;
    return Error{ErrorCode::usage, "the ground's albedo is not from 0 to 1", "",
                 "0.2 is that of grass and soil"};
  }
  return {};
}

double PreethamModel::Distribution::relative(double cos_theta, double gamma,
                                             double cos_gamma) const {
  const auto& [a, b, c, d, e] = perez;
  // b is negative, so at the horizon, where cos_theta is 0, the exponential is 0 too.
  return (1.0 + a * std::exp(b / cos_theta)) *
         (1.0 + c * std::exp(d * gamma) + e * cos_gamma * cos_gamma);
}

PreethamModel::PreethamModel(const PreethamSky& sky) : to_sun_(sun_direction(sky)) {
  const double sun_theta = sun_theta_of(sky);
  const auto fit = [&](const Fit& perez, double zenith) {
    Distribution distribution{perez_of(perez, sky.turbidity), 0.0};
    distribution.factor = zenith / distribution.relative(1.0, sun_theta, to_sun_.z);
    return distribution;
  };
  luminance_ = fit(kLuminanceFit, zenith_luminance(sky.turbidity, sun_theta));
  x_ = fit(kXFit, zenith_chromaticity(kZenithX, sky.turbidity, sun_theta));
  y_ = fit(kYFit, zenith_chromaticity(kZenithY, sky.turbidity, sun_theta));
  sun_irradiance_ = sunlight(sky.turbidity, air_mass(sky.sun_elevation));
  sky_irradiance_ = horizontal_irradiance([this](const glm::dvec3& d) { return above_horizon(d); });
  const glm::dvec3 on_ground = sky_irradiance_ + sun_irradiance_ * to_sun_.z;
  ground_radiance_ = sky.ground_albedo * on_ground / kPi;
}

SkyColour PreethamModel::colour(const glm::dvec3& direction) const {
  // The arc tangent keeps what the arc cosine loses next to the sun.
  const double cos_gamma = glm::dot(to_sun_, direction);
  const double gamma = std::atan2(glm::length(glm::cross(to_sun_, direction)), cos_gamma);
  const double cos_theta = std::abs(direction.z);  // -0 would be on the other side of infinity
  const auto value = [&](const Distribution& distribution) {
    return distribution.factor * distribution.relative(cos_theta, gamma, cos_gamma);
  };
  return {value(x_), value(y_), value(luminance_)};
}

glm::dvec3 PreethamModel::above_horizon(const glm::dvec3& direction) const {
  const auto [x, y, luminance] = colour(direction);
  return rec709_of(glm::dvec3(x, y, 1.0 - x - y) * (luminance / y));
}

glm::dvec3 PreethamModel::radiance(const glm::dvec3& direction) const {
  return direction.z < 0.0 ? ground_radiance_ : above_horizon(direction);
}

DiskLight PreethamModel::sun() const {
  return {to_sun_, glm::radians(kSunAngularRadius), sun_irradiance_ / kSunExtent};
}

double air_mass(double sun_elevation) {
  return 1.0 /
         (std::sin(glm::radians(sun_elevation)) + 0.15 * std::pow(3.885 + sun_elevation, -1.253));
}

glm::dvec3 sunlight(double turbidity, double air_mass) {
  glm::dvec3 xyz(0.0);
  for (int i = 0; i < kSpectrumCount; ++i) {
    const double nm = 380.0 + kSpectrumStep * i;
    xyz += matching_functions(nm) * kSunRadiance[i] *
           transmittance(nm / 1000.0, kOzone[i], air_mass, turbidity);
  }
  constexpr double kKilolumensPerWatt = 0.683;  // at 555 nm
  return rec709_of(xyz * (kSpectrumStep * kKilolumensPerWatt * kSunExtent));
}

glm::dvec3 sun_direction(const PreethamSky& sky) {
  const double elevation = glm::radians(sky.sun_elevation);
  // The panorama's centre is phi = pi, and phi grows to the right.
  const double phi = kPi + glm::radians(sky.sun_azimuth);
  return {std::cos(elevation) * std::cos(phi), std::cos(elevation) * std::sin(phi),
          std::sin(elevation)};
}

}  // namespace shoal
