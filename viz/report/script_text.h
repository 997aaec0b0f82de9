// Text that goes into the page, from names that may hold any byte.
#pragma once

#include <span>
#include <string>
#include <string_view>

#include "sphere/coefficients.h"

namespace shoal::viz {

// A JSON string with its quotes that may stand in HTML's <script> and in JavaScript: "<", ">" and
// "&" are escaped, so no "</script>" and no "<!--" is left, and so are U+2028 and U+2029, line ends
// to JavaScript before ES2019. Bytes that are not UTF-8 become U+FFFD, one each.
[[nodiscard]] std::string script_quoted(std::string_view text);

// HTML text or an attribute's value in double quotes. Bytes that are not UTF-8 become U+FFFD;
// control characters but tab and line feed, which HTML does not allow, do too.
[[nodiscard]] std::string html_escaped(std::string_view text);

// C's "%.17g", as coefficient tables write numbers; "null" for what is not finite.
[[nodiscard]] std::string exact_number(double value);

// Six significant digits, for figures that people read; "null" for what is not finite.
[[nodiscard]] std::string short_number(double value);

// "[a,b,...]" of short_number.
[[nodiscard]] std::string short_numbers(std::span<const double> values);

// r g b of every coefficient in index order as exact_number, blanks between. Precondition: they are
// finite.
[[nodiscard]] std::string exact_coefficients(const Coefficients& coefficients);

// RFC 4648 with padding.
[[nodiscard]] std::string base64(std::string_view bytes);

}  // namespace shoal::viz
