// What shoal says to a person, on standard error.
#pragma once

#include <string>
#include <vector>

#include "batch/run.h"
#include "core/result.h"

namespace shoal {

void print_error(const Error& error);

// What is to be said of files when a command ends.
struct FileNotes {
  std::vector<PanoramaNote> layouts;  // that were recognised
  std::vector<PanoramaNote> warnings;
  std::vector<PanoramaNote> failures;

  void add_layout(const std::string& file, const std::string& recognised);  // unless it is empty
  void add_warnings(const std::string& file, const std::vector<std::string>& texts);
  void add_failure(const std::string& file, const Error& error);  // unless it was interrupted
};

// "note: NAME: text", "warning: NAME: text" a line, the first few of many; then "failed: text", all
// of them.
void print_notes(const FileNotes& notes);

// What a run did, how fast, and where its results are.
void print_summary(const RunSummary& summary, const Manifest& manifest);

}  // namespace shoal
