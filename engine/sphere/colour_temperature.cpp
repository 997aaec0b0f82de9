#include "sphere/colour_temperature.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>
#include <glm/vec2.hpp>
#include <iterator>

namespace shoal {
namespace {

// A line of equal correlated temperature, 10^6 / mired kelvin: through (u, v) on the locus.
struct Isotherm {
  double mired, u, v, slope;
};
constexpr Isotherm kIsotherms[] = {
    {0, 0.18006, 0.26352, -0.24341},   {10, 0.18066, 0.26589, -0.25479},
    {20, 0.18133, 0.26846, -0.26876},  {30, 0.18208, 0.27119, -0.28539},
    {40, 0.18293, 0.27407, -0.30470},  {50, 0.18388, 0.27709, -0.32675},
    {60, 0.18494, 0.28021, -0.35156},  {70, 0.18611, 0.28342, -0.37915},
    {80, 0.18740, 0.28668, -0.40955},  {90, 0.18880, 0.28997, -0.44278},
    {100, 0.19032, 0.29326, -0.47888}, {125, 0.19462, 0.30141, -0.58204},
    {150, 0.19962, 0.30921, -0.70471}, {175, 0.20525, 0.31647, -0.84901},
    {200, 0.21142, 0.32312, -1.0182},  {225, 0.21807, 0.32909, -1.2168},
    {250, 0.22511, 0.33439, -1.4512},  {275, 0.23247, 0.33904, -1.7298},
    {300, 0.24010, 0.34308, -2.0637},  {325, 0.24792, 0.34655, -2.4681},
    {350, 0.25591, 0.34951, -2.9641},  {375, 0.26400, 0.35200, -3.5814},
    {400, 0.27218, 0.35407, -4.3633},  {425, 0.28039, 0.35577, -5.3762},
    {450, 0.28863, 0.35714, -6.7262},  {475, 0.29685, 0.35823, -8.5955},
    {500, 0.30505, 0.35907, -11.324},  {525, 0.31320, 0.35968, -15.628},
    {550, 0.32129, 0.36011, -23.325},  {575, 0.32931, 0.36038, -40.770},
    {600, 0.33724, 0.36051, -116.45}};
constexpr double kLeastMired = 10.0;  // 100,000 K: below it temperature says next to nothing

// From linear Rec.709 to CIE XYZ: the columns are the primaries, scaled so that equal parts give
// the white (ITU-R BT.709-6, item 1.3 and 1.4).
glm::dmat3 rec709_to_xyz() {
  const auto xyz = [](double x, double y) { return glm::dvec3(x / y, 1.0, (1.0 - x - y) / y); };
  const glm::dmat3 primaries(xyz(0.64, 0.33), xyz(0.30, 0.60), xyz(0.15, 0.06));
  const glm::dvec3 parts = glm::inverse(primaries) * xyz(0.3127, 0.3290);
  return {primaries[0] * parts[0], primaries[1] * parts[1], primaries[2] * parts[2]};
}

// How far the colour is on the isotherm's warmer side.
double distance(const glm::dvec2& uv, const Isotherm& line) {
  return ((uv.y - line.v) - line.slope * (uv.x - line.u)) /
         std::sqrt(1.0 + line.slope * line.slope);
}

// In the CIE 1960 diagram.
std::optional<glm::dvec2> uv_of(const glm::dvec3& rgb) {
  const glm::dvec3 xyz = rec709_to_xyz() * rgb;
  const double sum = xyz.x + 15.0 * xyz.y + 3.0 * xyz.z;
  // Written so that what is not a number has no chromaticity.
  if (!(xyz.x >= 0.0 && xyz.y > 0.0 && xyz.z >= 0.0) || !std::isfinite(sum)) return std::nullopt;
  return glm::dvec2(4.0 * xyz.x / sum, 6.0 * xyz.y / sum);
}

}  // namespace

double colour_distance(const glm::dvec3& a, const glm::dvec3& b) {
  const auto first = uv_of(a);
  const auto second = uv_of(b);
  // v' is 3/2 of v.
  return first && second ? glm::length((*first - *second) * glm::dvec2(1.0, 1.5)) : 0.0;
}

std::optional<double> correlated_colour_temperature(const glm::dvec3& rgb) {
  const auto chromaticity = uv_of(rgb);
  if (!chromaticity) return std::nullopt;
  const glm::dvec2 uv = *chromaticity;

  const auto is_warmer = [&](const Isotherm& line) { return distance(uv, line) > 0.0; };
  const auto* const warmer = std::ranges::find_if_not(kIsotherms, is_warmer);
  if (warmer == std::begin(kIsotherms) || warmer == std::end(kIsotherms)) return std::nullopt;
  const Isotherm& cooler = *(warmer - 1);
  const double to_cooler = distance(uv, cooler);
  const double part = to_cooler / (to_cooler - distance(uv, *warmer));
  const double mired = cooler.mired + part * (warmer->mired - cooler.mired);
  const glm::dvec2 locus(cooler.u + part * (warmer->u - cooler.u),
                         cooler.v + part * (warmer->v - cooler.v));
  const glm::dvec2 off = uv - locus;
  if (mired < kLeastMired || std::sqrt(off.x * off.x + off.y * off.y) > kMostOffLocus) {
    return std::nullopt;
  }
  return 1e6 / mired;
}

}  // namespace shoal
