// The version of the whole program, as CMakeLists.txt states it.
#pragma once

#include <string_view>

namespace shoal {

inline constexpr std::string_view kVersion = SHOAL_VERSION;

}  // namespace shoal
