// `shoal project --profile`: files for other programs in place of a table.
#pragma once

#include <CLI/CLI.hpp>
#include <memory>
#include <string>
#include <vector>

#include "app/common_options.h"
#include "core/result.h"
#include "output/coefficient_table.h"

namespace shoal {

struct ProfileOptions {
  std::string profile;               // empty: a table
  std::vector<std::string> choices;  // NAME=WORD
};

void add_profile_options(CLI::App& command, ProfileOptions& options);

// What takes radiance in the native frame and hands the profile's texts to `sink`, one after the
// other. `choice` becomes what has to be computed for it: its frame goes to the profile, its degree
// is at least the profile's. Errors: usage (the profile's; what only tables have is asked for; more
// than one panorama for a JSON file, which is one document).
Result<std::unique_ptr<TableWriter>> profile_writer(const ProfileOptions& options,
                                                    std::size_t panorama_count,
                                                    ComputeChoice& choice, TextSink sink);

}  // namespace shoal
