// The layouts in which pictures hold light from all directions.
//
// Where a picture's texels look is told in the native frame (sphere/conventions.h), so that one
// scene has the same coefficients in every layout:
//   equirect               sphere/quadrature.h.
//   cube_*                 six faces, each a perspective picture of 90 degrees, laid out as OpenGL
//                          and Direct3D do (OpenGL 4.6 specification, table 8.19) in cube_frame():
//                          +z is the panorama's centre, +x its right, +y up. So the pictures of the
//                          faces are not mirrored: +x right, -x left, +y up, -y down, +z front, -z
//                          back. A vertical cross has -z below -y, turned by 180 degrees; a
//                          horizontal one has it at the right of +x. Strips are +x -x +y -y +z -z.
//   cube_openexr           EXR's envmap CUBE: a vertical strip +X -X +Y -Y +Z -Z in OpenEXR's frame
//                          (+z centre, -x right, +y up), border texels on the faces' edges
//                          (OpenEXR, ImfEnvmap.h).
//   angular                Debevec's angular map, "light probe": the centre of the disc is the
//                          panorama's centre, right is right, up is up; the angle from the centre
//                          is pi times the radius. The rim is the direction behind.
//   mirror_ball            as angular, but the angle is 2 asin(radius): an ideal mirror seen from
//                          far away (Reinhard et al., "High Dynamic Range Imaging", 2010, chapter
//                          on image-based lighting). Like the others it is a picture seen from
//                          inside; a photograph of a ball is its mirror image.
//   octahedral             the octahedron |x|+|y|+|z| = 1 unfolded (Cigolle et al., "A Survey of
//                          Efficient Representations for Independent Unit Vectors", JCGT 3(2),
//                          2014): +z (up) in the square's middle, +x (behind) at its right edge, +y
//                          (left) at its lower edge, -z in its corners.
//   octahedral_equal_area  the same, but every texel has the same solid angle (Clarberg, "Fast
//                          Equal-Area Mapping of the (Hemi)Sphere using SIMD", JGT 13(3), 2008), as
//                          pbrt-v4's `imgtool makeequiarea` makes it of an equirect picture.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <string_view>

#include "core/result.h"
#include "sphere/frame.h"

namespace shoal {

enum class Layout {
  automatic,
  equirect,
  cube_vertical_cross,
  cube_horizontal_cross,
  cube_vertical_strip,
  cube_horizontal_strip,
  cube_faces,  // six files; their pictures one below the other make a vertical strip
  cube_openexr,
  angular,
  mirror_ball,
  octahedral,
  octahedral_equal_area,
};

struct LayoutName {
  std::string_view name;
  Layout layout;
};

// As manifests and the command line spell them.
inline constexpr std::array<LayoutName, 12> kLayoutNames = {{
    {"auto", Layout::automatic},
    {"equirect", Layout::equirect},
    {"cube-vertical-cross", Layout::cube_vertical_cross},
    {"cube-horizontal-cross", Layout::cube_horizontal_cross},
    {"cube-vertical-strip", Layout::cube_vertical_strip},
    {"cube-horizontal-strip", Layout::cube_horizontal_strip},
    {"cube-faces", Layout::cube_faces},
    {"cube-openexr", Layout::cube_openexr},
    {"angular", Layout::angular},
    {"mirror-ball", Layout::mirror_ball},
    {"octahedral", Layout::octahedral},
    {"octahedral-equal-area", Layout::octahedral_equal_area},
}};

[[nodiscard]] std::string_view name_of(Layout layout);

// Error: usage, with the nearest name.
[[nodiscard]] Result<Layout> parse_layout(std::string_view name);

// Whether the layout is made of the six faces of a cube.
[[nodiscard]] bool is_cube(Layout layout);

// The frame by whose axes the faces of all cubes but cube_openexr are named: +z,+x,+y.
[[nodiscard]] Frame cube_frame();

// The layout that pictures of such an aspect usually have: 2:1 equirect, 3:4 and 4:3 crosses, 1:6
// and 6:1 strips, 1:1 angular. Nothing for other aspects.
[[nodiscard]] std::optional<Layout> layout_of_aspect(int width, int height);

// A picture of this layout: 6N x N and so on. Precondition: a layout other than automatic; edge, of
// a face or of a square picture, >= 1; for equirect its height.
struct LayoutSize {
  int width = 0;
  int height = 0;
};
[[nodiscard]] LayoutSize size_of(Layout layout, int edge);

// What the aspect of a layout is called: "3:4".
[[nodiscard]] std::string_view aspect_of(Layout layout);

}  // namespace shoal
