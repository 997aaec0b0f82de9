// Which SIMD instruction sets this program was built for, and which one the kernels use.
//
// The choice changes speed only: every target gives the same bits.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "core/result.h"

namespace shoal::kernels {

// Names of the targets that were compiled and that this processor runs, best first.
[[nodiscard]] std::vector<std::string> available_targets();

// The target that the kernels use now.
[[nodiscard]] std::string active_target();

// Makes the kernels use the named target (upper or lower case) from the next call on. Not to be
// called while kernels run. Errors: usage, naming those there are.
Status force_target(std::string_view name);

}  // namespace shoal::kernels
