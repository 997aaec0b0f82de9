// What the place where messages go can show, and the few styles that the programs use
// there.
#pragma once

#include <cstddef>
#include <functional>
#include <string>
#include <string_view>

namespace shoal {

enum class Style { plain, bold, dim, red, green, yellow };

struct Terminal {
  enum class Kind {
    none,         // a pipe, a file, or a terminal that cannot move its cursor (TERM=dumb)
    interactive,  // a line can be redrawn
  };
  enum class Colour { off, on };

  Kind kind = Kind::none;
  Colour colour = Colour::off;
  int columns = 80;
};

// The value of an environment variable, empty where it is not set.
using Environment = std::function<std::string(const char* name)>;

enum class IsTty { no, yes };

// What a stream with this environment can show. Colour needs an interactive terminal and NO_COLOR
// unset or empty (no-color.org). `columns` <= 0 stands for unknown.
[[nodiscard]] Terminal terminal_of(IsTty tty, int columns, const Environment& environment);

// The same of an open file descriptor, as this process sees it now.
[[nodiscard]] Terminal terminal_of(int descriptor);

// The text in a style, or as it stands where the terminal has no colour.
[[nodiscard]] std::string styled(const Terminal& terminal, Style style, std::string_view text);

// "LABEL text" as a line on standard error, the label in its style and the text printable.
void print_message(Style style, std::string_view label, std::string_view text);

// A name fit to be shown on one line: control characters and bytes that are not UTF-8 become '?'.
[[nodiscard]] std::string printable(std::string_view name);

// How many columns a printable text takes at most: characters from U+1100 on count as two.
[[nodiscard]] std::size_t width_of(std::string_view text);

// The end of a printable text that fits into `columns`, behind "..." where something was cut off.
// The end, because that is where the names of panoramas differ.
[[nodiscard]] std::string fitted_end(std::string_view text, std::size_t columns);

}  // namespace shoal
