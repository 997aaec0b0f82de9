// A report's data as the page's scripts read them.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "library/library.h"
#include "library/pixels.h"
#include "report/figures.h"
#include "sphere/frame.h"

namespace shoal::viz {

// One row of the page's table.
struct IndexEntry {
  const Panorama* panorama = nullptr;
  std::string name;  // the panorama's, without a folder that all share
  Frame frame;       // of its coefficients, directions and axes
  LightFigures figures;
  double exposure = 1.0;  // automatic_exposure
  std::string thumbnail;  // a path beside the page or a data: URL; empty where there is none
  std::string ball;       // what irradiance_ball gives
  std::vector<std::string> warnings;  // of the panorama, without folders
};

// Irradiance over pi to degree 2, native frame, as "[[r,g,b], ...]" of the polynomials' factors
// 1, y, z, x, xy, yz, 3z^2-1, xz, x^2-y^2. As many as the degree has.
[[nodiscard]] std::string irradiance_ball(const Coefficients& radiance);

// {"title", "plain": what tables call the variant without a name, "frames": those of the entries,
// each once, "panoramas": [...], "failed": [...], "inline": null or what panorama_data gives of the
// only panorama}. `inlined` may be empty.
[[nodiscard]] std::string index_data(const Library& library, const std::vector<IndexEntry>& entries,
                                     const std::vector<FailedPanorama>& failed,
                                     const std::string& inlined);

// Everything of one panorama that the table does not need: {"width", "height", "rgbe": base64 of
// compressed_planes, "note", "native": base64 of the native frame's coefficients, little-endian
// doubles, r g b of each, and by the name of each quantity its exact_coefficients in the frame}.
// `pixels` may be empty, then `note` says why.
[[nodiscard]] std::string panorama_data(const Panorama& panorama, const Frame& frame,
                                        const Pixels& pixels, const std::string& note);

}  // namespace shoal::viz
