// The sun of a panorama, found in its pixels.
#pragma once

#include <cstdint>
#include <functional>
#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>
#include <optional>
#include <string>
#include <vector>

#include "core/result.h"
#include "sphere/sun.h"
#include "sphere/texel_mappings.h"
#include "sphere/texel_neighbours.h"
#include "transform/bright_texels.h"

namespace shoal {

// Which light is taken for the sun, and what becomes of it.
struct SunSettings {
  enum class Action {
    keep,     // it is only reported
    remove,   // its texels are lowered to the level
    replace,  // the same, and a uniform disk is put in its place
  };
  // One of the two is above 0, or no sun is looked for. The level above which light is the sun's:
  // that of all but this fraction of the sphere's solid angle, at most kMostBright;
  double top = 0.0;
  // or this one, in the file's own samples, if no more of the sphere than kMostBright is brighter.
  double above = 0.0;
  Action action = Action::keep;

  [[nodiscard]] bool asked() const { return top > 0.0 || above > 0.0; }
  friend bool operator==(const SunSettings&, const SunSettings&) = default;
};

// A picture's texels by row and column, and which of them touch.
struct TexelPlaces {
  std::function<Texel(int row, int column)> texel;
  TexelNeighbours neighbours;
};

// The sun, and which of `bright` its texels are, in ascending order. The region is that of the
// brightest texel; which texels touch says sphere/texel_neighbours.h.
// Colours are in the file's own; `share` is left for whoever knows the rest.
struct FoundSun {
  Sun sun;
  std::vector<std::size_t> members;
};

// Error: pixels, saying why there is none, as the end of "no sun was found: ".
[[nodiscard]] Result<FoundSun> find_sun(const BrightestTexels& bright, const SunSettings& settings,
                                        const TexelPlaces& places);

// What stays of a texel of the sun.
[[nodiscard]] BrightTexel lowered(const BrightTexel& texel, float level);

}  // namespace shoal
