// The header of NumPy's array files, format 1.0: numpy/lib/format.py, "Format Version 1.0".
#pragma once

#include <string>
#include <string_view>

namespace shoal {

// As long for every shape, so that it can be written over when the count is known. `type` is
// NumPy's, "<f8" or "<f4"; `shape` is a tuple's text, "(3, 9)". C order.
[[nodiscard]] std::string npy_header(std::string_view type, std::string_view shape);

}  // namespace shoal
