#include "core/diagnostic.h"

#include <algorithm>
#include <numeric>

namespace shoal {
namespace {

constexpr std::size_t kMaxColumns = 100;

// Whether a byte goes on with a UTF-8 character that began before it.
bool is_continuation(char byte) { return (static_cast<unsigned char>(byte) & 0xC0) == 0x80; }

// The first byte of a long line to be shown, so that the caret is in view.
std::size_t first_shown(std::string_view line, std::size_t caret) {
  if (line.size() <= kMaxColumns || caret <= kMaxColumns / 2) return 0;
  std::size_t first = std::min(caret - kMaxColumns / 2, line.size() - kMaxColumns);
  while (first < line.size() && is_continuation(line[first])) ++first;
  return first;
}

// Optimal string alignment distance: insertions, deletions, substitutions, neighbours swapped.
int edit_distance(std::string_view a, std::string_view b) {
  std::vector<std::vector<int>> d(a.size() + 1, std::vector<int>(b.size() + 1));
  for (std::size_t i = 0; i <= a.size(); ++i) d[i][0] = static_cast<int>(i);
  for (std::size_t j = 0; j <= b.size(); ++j) d[0][j] = static_cast<int>(j);
  for (std::size_t i = 1; i <= a.size(); ++i) {
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const int substitution = d[i - 1][j - 1] + (a[i - 1] == b[j - 1] ? 0 : 1);
      d[i][j] = std::min({d[i - 1][j] + 1, d[i][j - 1] + 1, substitution});
      const bool swapped = i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1];
      if (swapped) d[i][j] = std::min(d[i][j], d[i - 2][j - 2] + 1);
    }
  }
  return d[a.size()][b.size()];
}

}  // namespace

std::string format_diagnostic(const Diagnostic& diagnostic, std::string_view line) {
  std::string text;
  if (!diagnostic.loc.file.empty()) {
    text += diagnostic.loc.file;
    if (diagnostic.loc.line > 0) {
      text += ":" + std::to_string(diagnostic.loc.line);
      if (diagnostic.loc.column > 0) text += ":" + std::to_string(diagnostic.loc.column);
    }
    text += ": ";
  }
  text += diagnostic.severity == Severity::error ? "error: " : "warning: ";
  text += diagnostic.message + "\n";

  if (line.empty() || diagnostic.loc.column < 1) {
    if (!diagnostic.hint.empty()) text += "    " + diagnostic.hint + "\n";
    return text;
  }
  std::size_t caret = std::min(static_cast<std::size_t>(diagnostic.loc.column - 1), line.size());
  const std::size_t cut = first_shown(line, caret);
  std::size_t shown = std::min(line.size() - cut, kMaxColumns);
  while (cut + shown < line.size() && is_continuation(line[cut + shown])) --shown;
  line = line.substr(cut, shown);
  caret -= cut;
  text += "    " + std::string(line) + "\n    ";
  // Tabs stay tabs, so that the caret stands under its column however wide they are shown.
  for (std::size_t i = 0; i < caret; ++i) {
    if (!is_continuation(line[i])) text += line[i] == '\t' ? '\t' : ' ';
  }
  text += "^";
  if (!diagnostic.hint.empty()) text += " " + diagnostic.hint;
  return text + "\n";
}

std::string_view closest_match(std::string_view name,
                               std::span<const std::string_view> candidates) {
  std::string_view best;
  int best_distance = static_cast<int>(name.size() + 2) / 3 + 1;
  for (const std::string_view candidate : candidates) {
    const int distance = edit_distance(name, candidate);
    if (distance < best_distance) {
      best = candidate;
      best_distance = distance;
    }
  }
  return best;
}

std::optional<Error> unknown_command(std::string_view word,
                                     std::span<const std::string_view> commands) {
  if (word.starts_with("-") || std::ranges::find(commands, word) != commands.end()) return {};
  const std::string_view near = closest_match(word, commands);
  return Error{ErrorCode::usage, "no command \"" + std::string(word) + '"', "",
               near.empty() ? "--help lists them" : "did you mean \"" + std::string(near) + "\"?"};
}

}  // namespace shoal
