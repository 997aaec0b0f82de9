// Names in CSV and JSON. Names come from file systems, so they may hold any byte but 0.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace shoal {

// RFC 4180: as it stands, or in quotes with quotes doubled where it holds a comma, a quote or a
// line end. Bytes that are not UTF-8 stay as they are.
[[nodiscard]] std::string csv_quoted(std::string_view text);

// A JSON string with its quotes (RFC 8259). Bytes that are not UTF-8 become U+FFFD, one each.
[[nodiscard]] std::string json_quoted(std::string_view text);

// The length in bytes, 1 to 4, of the UTF-8 character that starts at `position`; 0 where none
// does. Overlong forms, surrogates and what lies above U+10FFFF are none (Unicode 15, table 3-7).
// Precondition: position < text.size().
[[nodiscard]] std::size_t utf8_length_at(std::string_view text, std::size_t position);

[[nodiscard]] bool is_utf8(std::string_view text);

// Two lower-case hexadecimal digits a byte.
[[nodiscard]] std::string hexadecimal(std::string_view bytes);

}  // namespace shoal
