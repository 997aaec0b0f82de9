// Pictures made smaller in their own layout.
#pragma once

#include <array>
#include <atomic>
#include <vector>

#include "core/result.h"
#include "image/panorama_source.h"
#include "sphere/texel_geometry.h"
#include "transform/area_weights.h"

namespace shoal {

struct SmallPicture {
  int width = 0;
  int height = 0;
  // Red, green, blue, each (height, width), linear Rec.709; the picture as it is looked at,
  // whichever way the file stores it.
  std::array<std::vector<float>, 3> planes;
  std::vector<char> has_light;  // (height, width): 0 where nothing was covered that counts
};

// Which of `count` smaller rows, or columns, each row or column of the picture belongs to.
struct SmallAxis {
  int count = 0;
  std::vector<AreaShare> shares;
};

// Each texel is the mean of those that it covers. Left out are texels with a channel that is not
// finite, and those that show nothing in `geometry`, where one is given; where nothing is covered,
// the picture is black. Reads the bands once, in one thread. `stop` ends it early.
// Accuracy: that of transform/scanline_means.h. Errors: the source's and its bands'; interrupted.
Result<SmallPicture> shrink(const PanoramaSource& source, SmallAxis rows, SmallAxis columns,
                            const TexelGeometry* geometry, const std::atomic<bool>& stop);

}  // namespace shoal
