// The layouts that one file holds, but for equirect.
#pragma once

#include "sphere/layout.h"

namespace shoal::test {

inline constexpr Layout kOneFile[] = {Layout::cube_vertical_cross,  Layout::cube_horizontal_cross,
                                      Layout::cube_vertical_strip,  Layout::cube_horizontal_strip,
                                      Layout::cube_openexr,         Layout::angular,
                                      Layout::mirror_ball,          Layout::octahedral,
                                      Layout::octahedral_equal_area};

}  // namespace shoal::test
