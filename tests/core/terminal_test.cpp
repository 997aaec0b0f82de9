#include "core/terminal.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <map>

namespace shoal {
namespace {

Terminal terminal_with(IsTty tty, const std::map<std::string, std::string>& variables) {
  return terminal_of(tty, 132, [&](const char* name) {
    const auto found = variables.find(name);
    return found == variables.end() ? std::string() : found->second;
  });
}

TEST(Terminal, ColourNeedsATerminalThatCanAndNoColorUnset) {
  const auto on = Terminal::Colour::on;
  const auto off = Terminal::Colour::off;
  EXPECT_EQ(terminal_with(IsTty::yes, {{"TERM", "xterm"}}).colour, on);
  EXPECT_EQ(terminal_with(IsTty::yes, {{"TERM", "xterm"}, {"NO_COLOR", ""}}).colour, on);
  EXPECT_EQ(terminal_with(IsTty::yes, {{"TERM", "xterm"}, {"NO_COLOR", "1"}}).colour, off);
  EXPECT_EQ(terminal_with(IsTty::yes, {{"TERM", "dumb"}}).colour, off);
  EXPECT_EQ(terminal_with(IsTty::yes, {}).colour, off);
  EXPECT_EQ(terminal_with(IsTty::no, {{"TERM", "xterm"}}).colour, off);
}

TEST(Terminal, ALineIsRedrawnOnlyWhereTheCursorMoves) {
  const auto interactive = Terminal::Kind::interactive;
  EXPECT_EQ(terminal_with(IsTty::yes, {{"TERM", "xterm"}, {"NO_COLOR", "1"}}).kind, interactive);
  EXPECT_EQ(terminal_with(IsTty::yes, {{"TERM", "dumb"}}).kind, Terminal::Kind::none);
  EXPECT_EQ(terminal_with(IsTty::no, {{"TERM", "xterm"}}).kind, Terminal::Kind::none);
}

TEST(Terminal, UnknownWidthsAreEighty) {
  const Environment empty = [](const char*) { return std::string(); };
  EXPECT_EQ(terminal_of(IsTty::yes, 132, empty).columns, 132);
  EXPECT_EQ(terminal_of(IsTty::yes, 0, empty).columns, 80);
}

TEST(Terminal, APipeIsNone) {
  int ends[2];
  ASSERT_EQ(::pipe(ends), 0);
  EXPECT_EQ(terminal_of(ends[1]).kind, Terminal::Kind::none);
  EXPECT_EQ(terminal_of(ends[1]).colour, Terminal::Colour::off);
  ::close(ends[0]);
  ::close(ends[1]);
}

TEST(Styled, WrapsInEscapesWhereColourIsOn) {
  const Terminal colour{Terminal::Kind::interactive, Terminal::Colour::on, 80};
  EXPECT_EQ(styled(colour, Style::red, "error"), "\x1b[31merror\x1b[0m");
  EXPECT_EQ(styled(colour, Style::bold, "x"), "\x1b[1mx\x1b[0m");
  EXPECT_EQ(styled(colour, Style::plain, "x"), "x");
  EXPECT_EQ(styled(Terminal(), Style::red, "error"), "error");
}

TEST(Printable, LetsNoControlThrough) {
  EXPECT_EQ(printable("gr\xc3\xbc\xc3\x9f/a b"), "gr\xc3\xbc\xc3\x9f/a b");
  EXPECT_EQ(printable("a\x1b[2J\n\x7f"), "a?[2J??");
  EXPECT_EQ(printable("\xc2\x9b"
                      "31m"),
            "?31m");  // CSI in one character, U+009B
  EXPECT_EQ(printable("\xff\xc3"), "??");
}

TEST(FittedEnd, KeepsTheEndAndNeverExceedsTheColumns) {
  EXPECT_EQ(fitted_end("abcdefgh", 8), "abcdefgh");
  EXPECT_EQ(fitted_end("abcdefgh", 7), "...efgh");
  EXPECT_EQ(fitted_end("abcdefgh", 3), "...");
  EXPECT_EQ(fitted_end("abcdefgh", 0), "");
  // Two columns each: what does not fit whole is left out.
  EXPECT_EQ(fitted_end("\xe6\x97\xa5\xe6\x9c\xac\xe6\x97\xa5", 6),
            "\xe6\x97\xa5\xe6\x9c\xac\xe6\x97\xa5");
  EXPECT_EQ(fitted_end("\xe6\x97\xa5\xe6\x9c\xac\xe6\x97\xa5", 5), "...\xe6\x97\xa5");
  EXPECT_EQ(fitted_end("\xe6\x97\xa5\xe6\x9c\xac\xe6\x97\xa5", 4), "...");
}

}  // namespace
}  // namespace shoal
