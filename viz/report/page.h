// The page's own text, from viz/report/page/, compiled in.
#pragma once

#include <string_view>

namespace shoal::viz {

// An HTML page with its style and scripts in it; @TITLE@ and @DATA@ stand where a report's own text
// goes, once each, in this order.
[[nodiscard]] std::string_view page_template();

}  // namespace shoal::viz
