// Messages about what a person wrote: file:line:column, the line, a caret, a hint.
// The one place that lays them out, so that every error of a manifest looks the same.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/result.h"

namespace shoal {

// A place in a text file. Lines and columns count from 1, columns in bytes; 0 means unknown.
struct SourceLoc {
  std::string file;
  int line = 0;
  int column = 0;
};

enum class Severity { error, warning };

struct Diagnostic {
  Severity severity = Severity::error;
  SourceLoc loc;
  std::string message;
  std::string hint;  // what to do next; may be empty
};

// Lays a diagnostic out:
//   library.yaml:7:5: error: unknown key "quadratur"
//       quadratur: texel
//       ^ did you mean "quadrature"?
// `line` is the text of the named line without its end; empty leaves the two lower lines out but
// for the hint. Long lines are cut around the caret to 100 columns.
[[nodiscard]] std::string format_diagnostic(const Diagnostic& diagnostic, std::string_view line);

// The candidate nearest to `name` by edit distance, if near enough to be what was meant, else "".
[[nodiscard]] std::string_view closest_match(std::string_view name,
                                             std::span<const std::string_view> candidates);

// What is wrong with a command line whose first word is `word`: there is no such command, with the
// one that was probably meant. Nothing where the word is one of them, or an option.
[[nodiscard]] std::optional<Error> unknown_command(std::string_view word,
                                                   std::span<const std::string_view> commands);

}  // namespace shoal
