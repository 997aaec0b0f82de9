// What shoal says to a person, on standard error.
#pragma once

#include <string_view>
#include <vector>

#include "batch/run.h"
#include "core/result.h"

namespace shoal {

void print_error(const Error& error);

// "warning: NAME: text" a line, the first few of many.
void print_warnings(const std::vector<PanoramaNote>& warnings);

// "note: NAME: text" a line, as many.
void print_notes(const std::vector<PanoramaNote>& notes);

// "failed: text" a line, all of them.
void print_failures(const std::vector<PanoramaNote>& failures);

// What a run did, how fast, and where its results are.
void print_summary(const RunSummary& summary, const Manifest& manifest);

}  // namespace shoal
