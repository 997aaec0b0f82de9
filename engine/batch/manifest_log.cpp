#include "batch/manifest_log.h"

#include <fmt/format.h>

#include <algorithm>
#include <tuple>
#include <utility>

#include "output/text_quoting.h"

namespace shoal {

void ManifestLog::add_text(std::string file, std::string text) {
  Text added{std::move(file), std::move(text), {0}};
  for (std::size_t i = 0; i < added.text.size(); ++i) {
    if (added.text[i] == '\n') added.line_starts.push_back(i + 1);
  }
  texts_.push_back(std::move(added));
}

void ManifestLog::add(Diagnostic diagnostic) {
  error_count_ += diagnostic.severity == Severity::error ? 1 : 0;
  diagnostics_.push_back(std::move(diagnostic));
}

void ManifestLog::error(SourceLoc loc, std::string message, std::string hint) {
  add({Severity::error, std::move(loc), std::move(message), std::move(hint)});
}

void ManifestLog::warning(SourceLoc loc, std::string message, std::string hint) {
  add({Severity::warning, std::move(loc), std::move(message), std::move(hint)});
}

std::size_t ManifestLog::index_of(std::string_view file) const {
  const auto it = std::find_if(texts_.begin(), texts_.end(),
                               [file](const Text& text) { return text.file == file; });
  return static_cast<std::size_t>(it - texts_.begin());
}

std::string_view ManifestLog::line(const SourceLoc& loc) const {
  const std::size_t index = index_of(loc.file);
  if (index == texts_.size() || loc.line < 1) return {};
  const Text& text = texts_[index];
  const auto number = static_cast<std::size_t>(loc.line);
  if (number > text.line_starts.size()) return {};
  std::string_view line = std::string_view(text.text).substr(text.line_starts[number - 1]);
  line = line.substr(0, line.find('\n'));
  if (line.ends_with('\r')) line.remove_suffix(1);
  return line;
}

SourceLoc ManifestLog::find_in_line(const SourceLoc& loc, std::string_view part) const {
  const std::string_view text = line(loc);
  const std::size_t column = text.find(part, static_cast<std::size_t>(std::max(loc.column, 1) - 1));
  if (column == std::string_view::npos) return loc;
  return {loc.file, loc.line, static_cast<int>(column) + 1};
}

std::vector<Diagnostic> ManifestLog::sorted() const {
  std::vector<Diagnostic> diagnostics = diagnostics_;
  std::stable_sort(diagnostics.begin(), diagnostics.end(),
                   [this](const Diagnostic& a, const Diagnostic& b) {
                     return std::tuple(index_of(a.loc.file), a.loc.line, a.loc.column) <
                            std::tuple(index_of(b.loc.file), b.loc.line, b.loc.column);
                   });
  return diagnostics;
}

std::string ManifestLog::format(const std::vector<Diagnostic>& diagnostics) const {
  std::string text;
  for (const Diagnostic& diagnostic : diagnostics) {
    text += format_diagnostic(diagnostic, line(diagnostic.loc));
  }
  return text;
}

std::string did_you_mean(std::string_view name, const std::vector<std::string_view>& candidates) {
  const std::string_view match = closest_match(name, candidates);
  return match.empty() ? "" : fmt::format("did you mean \"{}\"?", match);
}

std::string in_quotes(std::string_view text) {
  constexpr std::size_t kMaxShown = 80;
  std::string shown = "\"";
  std::size_t i = 0;
  while (i < std::min(text.size(), kMaxShown)) {
    const std::size_t length = utf8_length_at(text, i);
    const auto byte = static_cast<unsigned char>(text[i]);
    if (length == 0 || byte < 0x20 || byte == 0x7f) {
      shown += fmt::format("\\x{:02x}", byte);
    } else {
      shown += text.substr(i, length);
    }
    i += std::max<std::size_t>(length, 1);
  }
  return shown + (i < text.size() ? "...\"" : "\"");
}

}  // namespace shoal
