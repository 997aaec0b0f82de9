// Coordinate frames of other tools, by where the panorama lies in them.
#pragma once

#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>
#include <span>
#include <string>
#include <string_view>

#include "core/result.h"
#include "sphere/coefficients.h"

namespace shoal {

// One of the six half axes.
struct SignedAxis {
  int axis = 0;  // 0, 1, 2 for x, y, z
  int sign = 1;  // 1 or -1

  friend bool operator==(const SignedAxis&, const SignedAxis&) = default;
};

// The unit vector along it.
[[nodiscard]] glm::dvec3 direction_of(const SignedAxis& axis);

// A frame is told by where the panorama's centre, the point a quarter turn to the right of it in
// the picture, and its upper edge lie. The default is the native frame of sphere/conventions.h. The
// three are half axes of three different axes.
struct Frame {
  SignedAxis center{0, -1};
  SignedAxis right{1, -1};
  SignedAxis up{2, 1};

  friend bool operator==(const Frame&, const Frame&) = default;
};

// A name for a frame that a known tool uses, with where that is established.
struct FrameAlias {
  std::string_view name;
  Frame frame;
  std::string_view source;
};

[[nodiscard]] std::span<const FrameAlias> frame_aliases();

// An alias, or "center,right,up" such as "+z,-x,+y". Blanks and case do not matter; a plus may be
// left out. Errors: usage, for an unknown name (with the nearest one), an axis that is none, two
// directions on one axis.
[[nodiscard]] Result<Frame> parse_frame(std::string_view text);

// The same from the three axes' texts. Errors as above.
[[nodiscard]] Result<Frame> parse_frame(std::string_view center, std::string_view right,
                                        std::string_view up);

// "+z,-x,+y"; parse_frame reads it back.
[[nodiscard]] std::string text_of(const Frame& frame);

// The signed permutation M that takes native directions to the frame's: x_frame = M x_native.
[[nodiscard]] glm::dmat3 native_to_frame(const Frame& frame);

// Whether native_to_frame is a reflection. The native frame, right-handed, sees its picture
// mirrored from inside; so these are the frames that, taken as right-handed, see it the right way
// round.
[[nodiscard]] bool mirrors(const Frame& frame);

// The coefficients, given in the native frame, of the same light in the frame. The native frame
// leaves the bits as they are.
[[nodiscard]] Coefficients to_frame(const Coefficients& native, const Frame& frame);

}  // namespace shoal
