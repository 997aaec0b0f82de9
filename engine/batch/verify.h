// Outputs and inputs held against the store: is everything still as the last run left it?
#pragma once

#include <atomic>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "core/result.h"

namespace shoal {

struct VerifyOptions {
  enum class Recompute {
    no,
    yes,  // project every file again; the coefficients must be the same bits
  };
  Recompute recompute = Recompute::no;
  int threads = 1;
};

struct VerifyReport {
  std::int64_t panorama_count = 0;
  std::int64_t output_count = 0;  // files whose content was compared
  std::int64_t recomputed_count = 0;
  std::vector<std::string> problems;  // a sentence each: what differs, and where
};

// `folder`: the output folder of a run. Errors: those of the store; interrupted.
Result<VerifyReport> verify_outputs(const std::filesystem::path& folder,
                                    const VerifyOptions& options, const std::atomic<bool>& stop);

}  // namespace shoal
