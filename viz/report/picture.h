// The pictures of a report: small HDR pictures in RGBE, and PNG thumbnails.
#pragma once

#include <string>
#include <string_view>

#include "library/pixels.h"

namespace shoal::viz {

// What every PNG of a report says of its maker, by which a later report knows it as its own.
inline constexpr std::string_view kPngSoftware = "shoal report";

// Four planes R, G, B, E of (height, width) bytes, compressed by `compressed_planes`. A texel is
// mantissa * 2^(E - 136), all 0 for black; rounded to nearest, 255 at most, so a channel's error is
// at most 1/256 of the texel's largest channel, between 1e-38 and 1e38. Negative and NaN become 0.
// Source of the format: G. Ward, "Real Pixels", Graphics Gems II, 1991.
[[nodiscard]] std::string rgbe_planes(const Pixels& pixels);

// Every byte less its left neighbour (the one above in the first column), in zlib format (RFC
// 1950), which browsers inflate themselves. Precondition: bytes.size() is a multiple of `width`.
[[nodiscard]] std::string compressed_planes(std::string_view bytes, int width);

// The picture at width x width/2, each texel the mean of those it covers.
[[nodiscard]] Pixels shrunk(const Pixels& pixels, int width);

// Eight-bit sRGB of exposure * pixels, clipped at white.
[[nodiscard]] std::string srgb_png(const Pixels& pixels, double exposure);

}  // namespace shoal::viz
