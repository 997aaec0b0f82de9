// Pictures that are painted from a function of the direction, band by band, as if read from a file.
#pragma once

#include <array>
#include <filesystem>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "core/result.h"
#include "image/map_writer.h"
#include "image/panorama_source.h"
#include "sphere/analytic_lights.h"

namespace shoal {

// Linear Rec.709 in a unit direction of the native frame. Called by several threads at once.
using RadianceFunction = std::function<glm::dvec3(const glm::dvec3& direction)>;

// What is painted: the function, the disks and the directional lights together.
struct Painting {
  std::string format;  // for people: "Preetham sky"
  int width = 0;
  int height = 0;
  RadianceFunction radiance;     // with few edges; none: black
  std::vector<DiskLight> disks;  // whose edges are painted with care, however small they are
  std::vector<DirectionalLight> directional;
};

// An equirect picture, float samples, bands in any order. Texels are averages over their solid
// angle, which is what the quadrature `texel` takes them for:
// - of the function, by 2 x 2 Gauss-Legendre nodes: an error of the fourth order in the texel's
//   side where the function is smooth;
// - of a disk, by the share of the texel that it covers (sphere/disk_coverage.h), so that its flux
//   is the light's to 1e-9, float samples aside, however small it is;
// - a directional light, which is infinite where it is, is given to the four texels around its
//   direction, by bilinear shares of its irradiance: its flux is the light's, and each coefficient
//   is the bilinear interpolation of Y_lm's averages over texels, between their mean angles, which
//   is of the second order in the texel's side. Over a pole lies the first row again, half way
//   round.
// The same bits whatever the bands and the threads.
// Error: usage, for sides that are not 1 .. kMaxSide, or more pixels than kMaxPixels.
// Precondition: check_light of each light.
Result<std::unique_ptr<PanoramaSource>> paint(Painting painting);

// Lights in closed form, all together, as a painting. Precondition: check_light of each.
[[nodiscard]] Painting painting_of(std::span<const AnalyticLight> lights, int width, int height);

// Writes all of a source of float planes and commits it. `file` has the source's size. Errors: the
// source's, MapWriter's.
Status write_picture(const PanoramaSource& source, const std::filesystem::path& path,
                     const MapFile& file);

}  // namespace shoal
