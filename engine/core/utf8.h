// Characters in texts that may hold any bytes.
#pragma once

#include <cstddef>
#include <string_view>

namespace shoal {

// The UTF-8 character, 1 to 4 bytes, that starts at `position`; empty where none does. Overlong
// forms, surrogates and what lies above U+10FFFF are none (Unicode 15, table 3-7).
// Precondition: position < text.size().
[[nodiscard]] std::string_view utf8_character_at(std::string_view text, std::size_t position);

}  // namespace shoal
