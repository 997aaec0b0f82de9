#include "output/light_table.h"

#include <fmt/format.h>

#include <cmath>
#include <glm/mat3x3.hpp>
#include <glm/trigonometric.hpp>

#include "output/text_quoting.h"

namespace shoal {
namespace {

constexpr int kSunColumns = 14;
constexpr int kDominantColumns = 8;

// What is no number is empty, as what is not there.
void add(std::string& line, double value) {
  line += ',';
  if (std::isfinite(value)) line += fmt::format("{:.17g}", value);
}

void add(std::string& line, const glm::dvec3& vector) {
  for (int i = 0; i < 3; ++i) add(line, vector[i]);
}

void add(std::string& line, const Sun& sun, const glm::dmat3& to_frame) {
  add(line, to_frame * sun.direction);
  add(line, glm::degrees(sun.angular_radius));
  add(line, sun.irradiance);
  add(line, sun.disk().radiance);
  add(line, sun.solid_angle);
  add(line, sun.share);
  line += fmt::format(",{}", sun.texel_count);
  add(line, sun.level);
}

}  // namespace

std::string light_csv_header() {
  return "panorama,sun_x,sun_y,sun_z,sun_radius,sun_r,sun_g,sun_b,sun_radiance_r,sun_radiance_g,"
         "sun_radiance_b,sun_solid_angle,sun_share,sun_texels,sun_level,dominant_x,dominant_y,"
         "dominant_z,dominant_r,dominant_g,dominant_b,directionality,dominant_energy\n";
}

std::string light_csv_row(const LightRecord& record) {
  const glm::dmat3 to_frame = native_to_frame(record.frame);
  std::string line = csv_quoted(record.panorama);
  if (record.sun) {
    add(line, *record.sun, to_frame);
  } else {
    line.append(kSunColumns, ',');
  }
  if (const auto& dominant = record.dominant) {
    add(line, to_frame * dominant->light.direction);
    add(line, dominant->light.irradiance);
    add(line, dominant->directionality);
    add(line, dominant->energy_share);
  } else {
    line.append(kDominantColumns, ',');
  }
  return line + "\n";
}

}  // namespace shoal
