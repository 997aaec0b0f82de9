// The diagnostics of a manifest and of the files that it includes, collected to be told in one go.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "core/diagnostic.h"

namespace shoal {

class ManifestLog {
 public:
  // Makes a file's text known, for the lines under its diagnostics. Diagnostics come in the order
  // in which their files were made known, then by line and column.
  void add_text(std::string file, std::string text);

  void error(SourceLoc loc, std::string message, std::string hint = "");
  void warning(SourceLoc loc, std::string message, std::string hint = "");

  [[nodiscard]] int error_count() const { return error_count_; }

  // Where `part` stands in the line of `loc`, at its column or behind it; `loc` where it does not.
  [[nodiscard]] SourceLoc find_in_line(const SourceLoc& loc, std::string_view part) const;

  // Sorted by position; two at the same place stay in the order in which they came.
  [[nodiscard]] std::vector<Diagnostic> sorted() const;
  [[nodiscard]] std::string format(const std::vector<Diagnostic>& diagnostics) const;

 private:
  struct Text {
    std::string file;
    std::string text;
    std::vector<std::size_t> line_starts;
  };

  void add(Diagnostic diagnostic);
  [[nodiscard]] std::size_t index_of(std::string_view file) const;
  [[nodiscard]] std::string_view line(const SourceLoc& loc) const;

  std::vector<Text> texts_;
  std::vector<Diagnostic> diagnostics_;
  int error_count_ = 0;
};

// `hint` for a misspelt `name`: did you mean "..."?, or "" where no candidate is near.
[[nodiscard]] std::string did_you_mean(std::string_view name,
                                       const std::vector<std::string_view>& candidates);

// Text from outside in double quotes, with control characters and stray bytes as \xHH, cut where
// long.
[[nodiscard]] std::string in_quotes(std::string_view text);

}  // namespace shoal
