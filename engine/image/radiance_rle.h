// Scanlines of Radiance pictures, in their three encodings, into four byte planes.
//
// Each scanline tells its own encoding, so one file may mix them:
//   new RLE  2, 2, width as two bytes, then the four components one after another, each as
//            runs (128 + n, value) and literals (n, n bytes); widths 8 to 32767 only
//   old RLE  interleaved pixels r, g, b, e; a pixel 1, 1, 1, n repeats its predecessor n times, and
//            repeats that follow each other count n, 256 n, 65536 n ...
//   flat     interleaved pixels; old RLE without repeats
//
// Writers that do not normalise their texels make flat files in which 1, 1, 1, n is a texel. Such a
// file is told by its size: it has four bytes a pixel, which leaves nothing that a repeat could
// stand for but the one pixel whose place its mark takes.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

namespace shoal {

// Runs are copied in whole vectors, so bytes this far behind the end of the input are read (and not
// used), and as many behind the end of each plane's scanline are written (with anything).
inline constexpr std::size_t kRadianceSlack = 64;

// What the size of all scanlines together says about them.
enum class DataSize {
  any,
  of_flat,  // four bytes a pixel: 1, 1, 1, n is a repeat for n = 1 only, and a texel otherwise
};

enum class ScanlineState {
  whole,      // expanded
  cut_short,  // the input ends before the scanline does
  broken,     // the bytes break the rules; `fault` says how
};

struct ScanlineResult {
  ScanlineState state = ScanlineState::whole;
  std::size_t bytes = 0;  // of input, when whole
  const char* fault = "";
};

// Expands the scanline at the front of `input` into `planes` (R, G, B, E; `width` bytes each).
ScanlineResult expand_radiance_scanline(std::span<const std::uint8_t> input, int width,
                                        DataSize data_size,
                                        const std::array<std::uint8_t*, 4>& planes);

// Finds the end of the scanline at the front of `input` without expanding it, where its encoding
// allows; else it is expanded into `planes`. As expand_radiance_scanline in all else.
ScanlineResult skip_radiance_scanline(std::span<const std::uint8_t> input, int width,
                                      DataSize data_size,
                                      const std::array<std::uint8_t*, 4>& planes);

// Whether new RLE exists for scanlines of this width.
[[nodiscard]] constexpr bool allows_new_rle(int width) { return width >= 8 && width <= 32767; }

// The bytes with which every scanline in new RLE begins.
// Precondition: allows_new_rle(width).
[[nodiscard]] constexpr std::array<std::uint8_t, 4> new_rle_marker(int width) {
  return {2, 2, static_cast<std::uint8_t>(width >> 8), static_cast<std::uint8_t>(width & 255)};
}

// The fewest bytes that any encoding needs for a scanline of `width` >= 1 pixels.
[[nodiscard]] std::uint64_t smallest_radiance_scanline(int width);

}  // namespace shoal
