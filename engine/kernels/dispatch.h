// Choosing among the copies of a kernel that Highway's foreach_target compiles, one a SIMD target.
//
// Highway's own HWY_DYNAMIC_DISPATCH lives in its library, whose other parts measure the
// processor's timer when it is loaded: 3 to 4 ms at every start of the program, most of what a
// start takes. So this uses Highway's headers and tables alone.
#pragma once

#include <hwy/highway.h>

#include <cstddef>

namespace shoal::kernels {

inline constexpr std::size_t kTargetSlots = HWY_MAX_DYNAMIC_TARGETS + 1;

// The slot of the target in use, best target first; the last slot is the portable one.
[[nodiscard]] std::size_t active_slot();

}  // namespace shoal::kernels

// Defines the table of a kernel's copies; used once, where HWY_ONCE is true.
#define SHOAL_KERNEL_TABLE(FUNCTION)                                                      \
  constexpr decltype(&HWY_STATIC_DISPATCH(FUNCTION)) k##FUNCTION##Table[kTargetSlots] = { \
      HWY_CHOOSE_TARGET_LIST(FUNCTION), HWY_CHOOSE_FALLBACK(FUNCTION)}

// Calls the copy of the target in use.
#define SHOAL_CALL_KERNEL(FUNCTION) (*k##FUNCTION##Table[active_slot()])
