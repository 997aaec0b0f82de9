#include "core/diagnostic.h"

#include <gtest/gtest.h>

#include <array>

namespace shoal {
namespace {

TEST(FormatDiagnostic, ShowsTheLineACaretAndAHint) {
  const Diagnostic diagnostic{Severity::error,
                              {"library.yaml", 7, 5},
                              "unknown key \"quadratur\"",
                              "did you mean \"quadrature\"?"};
  EXPECT_EQ(format_diagnostic(diagnostic, "    quadratur: texel"),
            "library.yaml:7:5: error: unknown key \"quadratur\"\n"
            "        quadratur: texel\n"
            "        ^ did you mean \"quadrature\"?\n");
}

TEST(FormatDiagnostic, DoesWithoutLineOrPlace) {
  EXPECT_EQ(format_diagnostic({Severity::warning, {"a.yaml", 0, 0}, "is empty", "add entries"}, ""),
            "a.yaml: warning: is empty\n    add entries\n");
  EXPECT_EQ(format_diagnostic({Severity::error, {}, "no manifest", ""}, ""),
            "error: no manifest\n");
}

TEST(FormatDiagnostic, CutsALongLineAroundTheCaret) {
  const std::string line = std::string(300, 'a') + "X" + std::string(300, 'b');
  const std::string text = format_diagnostic({Severity::error, {"f", 1, 301}, "m", ""}, line);
  const std::size_t shown = text.find('\n') + 1;
  const std::size_t caret_line = text.find('\n', shown) + 1;
  EXPECT_EQ(caret_line - shown, 4 + 100 + 1U);
  EXPECT_EQ(text[shown + (text.find('^') - caret_line)], 'X');
}

TEST(FormatDiagnostic, KeepsTabsUnderTabs) {
  EXPECT_EQ(format_diagnostic({Severity::error, {"f", 1, 2}, "m", ""}, "\tx"),
            "f:1:2: error: m\n    \tx\n    \t^\n");
}

// Columns are bytes, of which "ä" has two; the caret stands under what is seen.
TEST(FormatDiagnostic, PutsTheCaretUnderItsCharacterBehindUtf8) {
  EXPECT_EQ(format_diagnostic({Severity::error, {"f", 1, 5}, "m", ""}, "\u00e4\u00e4x"),
            "f:1:5: error: m\n    \u00e4\u00e4x\n      ^\n");
}

TEST(ClosestMatch, FindsTyposAndNothingFarAway) {
  constexpr std::array<std::string_view, 3> keys = {"quadrature", "degree", "exclude"};
  EXPECT_EQ(closest_match("quadratur", keys), "quadrature");
  EXPECT_EQ(closest_match("dergee", keys), "degree");
  EXPECT_EQ(closest_match("exlcude", keys), "exclude");
  EXPECT_EQ(closest_match("panoramas", keys), "");
}

TEST(UnknownCommand, NamesTheOneThatWasMeant) {
  constexpr std::array<std::string_view, 3> commands = {"run", "render", "report"};
  EXPECT_EQ(unknown_command("rednr", commands)->text(),
            "no command \"rednr\" (did you mean \"render\"?)");
  EXPECT_EQ(unknown_command("panoramas", commands)->text(),
            "no command \"panoramas\" (--help lists them)");
  EXPECT_EQ(unknown_command("rnu", commands)->code, ErrorCode::usage);
  EXPECT_FALSE(unknown_command("run", commands));
  EXPECT_FALSE(unknown_command("--rnu", commands));
}

}  // namespace
}  // namespace shoal
