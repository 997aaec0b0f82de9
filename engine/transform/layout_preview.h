// Previews of pictures in every layout but equirect: resampled into an equirect one.
#pragma once

#include <atomic>

#include "core/result.h"
#include "sphere/layout.h"
#include "transform/layout_source.h"
#include "transform/small_picture.h"

namespace shoal {

// An equirect picture of `width` times (width + 1) / 2 texels, or of as many columns as the picture
// has texels all around where these are fewer (four faces; twice an octahedron's edge; a disc's
// diameter).
//
// The picture is first made smaller in its own layout, each texel the mean of those that it covers,
// to about two of them along a texel of the preview. Then each texel of the preview is the mean of
// 3 x 3 directions in it, between whose nearest four texels is interpolated, not across the edges
// of a square. So everything bright is seen, and the light of the sphere is kept but for the second
// order in the texels' size. Behind a disc, where it shows nothing, its rim goes on.
// Errors: those of shrink(); usage (a size that the layout does not have).
Result<SmallPicture> layout_preview(const LaidOutPicture& picture, int width,
                                    const std::atomic<bool>& stop);

}  // namespace shoal
