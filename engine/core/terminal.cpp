#include "core/terminal.h"

#include <sys/ioctl.h>
#include <unistd.h>

#include <cstdio>
#include <cstdlib>

#include "core/utf8.h"

namespace shoal {
namespace {

constexpr int kDefaultColumns = 80;

// Select Graphic Rendition, ECMA-48 8.3.117.
const char* escape_of(Style style) {
  switch (style) {
    case Style::plain:
      return "";
    case Style::bold:
      return "\x1b[1m";
    case Style::dim:
      return "\x1b[2m";
    case Style::red:
      return "\x1b[31m";
    case Style::green:
      return "\x1b[32m";
    case Style::yellow:
      return "\x1b[33m";
  }
  return "";
}

// The character that starts there, or the byte that starts none.
std::string_view next_of(std::string_view text, std::size_t position) {
  const std::string_view character = utf8_character_at(text, position);
  return character.empty() ? text.substr(position, 1) : character;
}

// From U+1100, E1 84 80, on lie all characters that terminals show two columns wide.
std::size_t columns_of(std::string_view character) {
  return character.size() >= 3 && character >= std::string_view("\xe1\x84\x80") ? 2 : 1;
}

}  // namespace

Terminal terminal_of(IsTty tty, int columns, const Environment& environment) {
  Terminal terminal;
  const std::string type = environment("TERM");
  if (tty == IsTty::yes && !type.empty() && type != "dumb") {
    terminal.kind = Terminal::Kind::interactive;
    if (environment("NO_COLOR").empty()) terminal.colour = Terminal::Colour::on;
  }
  terminal.columns = columns > 0 ? columns : kDefaultColumns;
  return terminal;
}

Terminal terminal_of(int descriptor) {
  winsize size{};
  const bool known = ::ioctl(descriptor, TIOCGWINSZ, &size) == 0;
  return terminal_of(::isatty(descriptor) ? IsTty::yes : IsTty::no, known ? size.ws_col : 0,
                     [](const char* name) -> std::string {
                       const char* value = std::getenv(name);
                       return value ? value : "";
                     });
}

std::string styled(const Terminal& terminal, Style style, std::string_view text) {
  if (terminal.colour == Terminal::Colour::off || style == Style::plain) return std::string(text);
  return std::string(escape_of(style)).append(text).append("\x1b[0m");
}

void print_message(Style style, std::string_view label, std::string_view text) {
  static const Terminal kStandardError = terminal_of(STDERR_FILENO);
  const std::string line = styled(kStandardError, style, label) + ' ' + printable(text) + '\n';
  std::fputs(line.c_str(), stderr);
}

std::string printable(std::string_view name) {
  std::string text;
  for (std::size_t i = 0; i < name.size();) {
    const std::string_view character = utf8_character_at(name, i);
    const auto c = static_cast<unsigned char>(name[i]);
    // U+0080..U+009F, C2 80 .. C2 9F, are control characters too.
    const bool control =
        c < 0x20 || c == 0x7f ||
        (c == 0xc2 && character.size() == 2 && static_cast<unsigned char>(character[1]) < 0xa0);
    text += character.empty() || control ? "?" : character;
    i += next_of(name, i).size();
  }
  return text;
}

std::size_t width_of(std::string_view text) {
  std::size_t columns = 0;
  for (std::size_t i = 0; i < text.size();) {
    const std::string_view character = next_of(text, i);
    columns += columns_of(character);
    i += character.size();
  }
  return columns;
}

std::string fitted_end(std::string_view text, std::size_t columns) {
  constexpr std::string_view kDots = "...";
  std::size_t width = width_of(text);
  if (width <= columns) return std::string(text);
  if (columns <= kDots.size()) return std::string(kDots.substr(0, columns));
  while (width > columns - kDots.size()) {
    const std::string_view character = next_of(text, 0);
    width -= columns_of(character);
    text.remove_prefix(character.size());
  }
  return std::string(kDots).append(text);
}

}  // namespace shoal
