// The lights that stand out of panoramas: their suns and their dominant lights.
//
// CSV: one row a panorama, RFC 4180 quoting, "\n" line ends, numbers like C's "%.17g"; empty where
// there is no such light. Directions point to the light, in the record's frame; colours are linear
// Rec.709.
//   panorama
//   sun_x sun_y sun_z         the sun found in the pixels (sphere/sun.h): unit direction
//   sun_radius                degrees of arc, of its disk, as the radius of a disk in a manifest
//   sun_r sun_g sun_b         irradiance of a surface that faces it
//   sun_radiance_r .. _b      of that disk, which has the sun's flux
//   sun_solid_angle sun_share sun_texels sun_level
//   dominant_x .. _z          the directional light of sphere/dominant_light.h
//   dominant_r .. _b          irradiance of a surface that faces it
//   directionality dominant_energy
#pragma once

#include <optional>
#include <string>

#include "sphere/analytic_lights.h"
#include "sphere/frame.h"
#include "sphere/sun.h"

namespace shoal {

struct LightRecord {
  struct Dominant {
    DirectionalLight light;
    double directionality = 0.0;
    double energy_share = 0.0;
  };
  std::string panorama;
  std::optional<Sun> sun;  // directions in the native frame
  std::optional<Dominant> dominant;
  Frame frame;  // that they are told in
};

[[nodiscard]] std::string light_csv_header();
[[nodiscard]] std::string light_csv_row(const LightRecord& record);

}  // namespace shoal
