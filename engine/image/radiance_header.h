// The text in front of a Radiance picture: what the samples mean and how scanlines run.
//
// Source: "Radiance File Formats" (Lawrence Berkeley National Laboratory), section Picture Files.
#pragma once

#include <cstdint>
#include <glm/mat3x3.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "core/input_file.h"
#include "core/result.h"
#include "image/panorama_source.h"

namespace shoal {

enum class RadianceColour { rgbe, xyze };

struct RadianceHeader {
  RadianceColour colour = RadianceColour::rgbe;

  // The slow axis of the resolution line, and how many samples a scanline has.
  int scanline_count = 0;
  int scanline_width = 0;
  ScanAxis scan_axis = ScanAxis::rows;
  bool scanlines_reversed = false;  // the first scanline is the bottom row, or the rightmost column
  bool samples_reversed = false;    // as PictureInfo says

  std::uint64_t data_offset = 0;  // of the first scanline

  // From the file's samples to linear Rec.709. The samples are the scene's times every EXPOSURE and
  // COLORCORR of the header, so this divides by them; XYZE samples then go through xyz_to_rec709().
  glm::dmat3 to_linear_rec709{1.0};

  std::vector<std::string> warnings;
};

// How many of a file's first bytes looks_like_radiance() wants to see.
inline constexpr std::size_t kRadianceSignatureBytes = 512;

// Whether a file that starts so is a Radiance picture: "#?" at its start or, in pictures of before
// 1991 that have no such line, a FORMAT line.
[[nodiscard]] bool looks_like_radiance(std::string_view first_bytes);

// Reads the header and checks the declared size against the file's.
// Errors: malformed; unsupported (another FORMAT, a size above kMaxSide or kMaxPixels).
Result<RadianceHeader> read_radiance_header(const InputFile& file);

// CIE 1931 XYZ to linear Rec.709 (primaries and D65 white of ITU-R BT.709), Y = 1 to white 1,1,1.
//
// Radiance's own RGB has other primaries and an equal-energy white. XYZ needs neither: tristimulus
// values do not depend on who wrote them, so they are converted as they are, without an adaptation
// of white. An XYZE picture that Radiance made from its white therefore is slightly reddish here.
[[nodiscard]] glm::dmat3 xyz_to_rec709();

}  // namespace shoal
