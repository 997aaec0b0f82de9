// A run: plan, project, write, remember.
#pragma once

#include <atomic>
#include <cstdint>
#include <string>
#include <vector>

#include "batch/manifest.h"
#include "batch/plan.h"
#include "batch/progress.h"
#include "core/result.h"

namespace shoal {

struct RunSettings {
  enum class OnFailure {
    go_on,
    stop,  // the first panorama that fails ends the run; finished work is kept
  };
  int threads = 1;
  OnFailure on_failure = OnFailure::go_on;
};

// A sentence about one panorama.
struct PanoramaNote {
  std::string panorama;
  std::string text;
};

struct RunSummary {
  std::int64_t done_count = 0;
  std::int64_t up_to_date_count = 0;
  std::int64_t pixel_count = 0;
  std::uint64_t byte_count = 0;        // of the files that were read
  double seconds = 0.0;                // wall time of the projecting
  std::vector<PanoramaNote> failures;  // in manifest order, as are the next
  std::vector<PanoramaNote> warnings;
  std::vector<PanoramaNote> layouts;  // that were recognised, and how
  std::int64_t missing_count = 0;     // of the manifest, but not in the tables
  std::vector<std::string> tables;    // paths
  std::int64_t map_count = 0;         // maps and pictures written; the next: exports
  std::int64_t export_count = 0;
  bool interrupted = false;
};

// Does what the plan says, then writes the tables anew if what they hold has changed. Failures of
// single panoramas are in the summary; errors are those that end the run: the store, the tables.
Result<RunSummary> run_plan(const Manifest& manifest, const Plan& plan, Store& store,
                            const RunSettings& settings, Progress& progress,
                            std::atomic<bool>& stop);

}  // namespace shoal
