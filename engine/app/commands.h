// The subcommands of shoal. Each adds its options to its parser and leaves in `action` what to do
// once the command line is understood; the action returns the exit status.
#pragma once

#include <CLI/CLI.hpp>
#include <functional>

namespace shoal {

// What the program's exit status says.
enum ExitStatus : int {
  kExitOk = 0,
  kExitFailed = 1,         // at least one panorama failed, or a check found something
  kExitUsage = 2,          // nothing was run: the command line or the manifest is wrong
  kExitInterrupted = 130,  // finished work is kept
};

using Action = std::function<int()>;

void add_run_options(CLI::App& command, Action& action);
void add_project_options(CLI::App& command, Action& action);
void add_check_options(CLI::App& command, Action& action);
void add_init_options(CLI::App& command, Action& action);
void add_verify_options(CLI::App& command, Action& action);
void add_preview_options(CLI::App& command, Action& action);
void add_profiles_options(CLI::App& command, Action& action);
void add_quality_options(CLI::App& command, Action& action);
void add_targets_options(CLI::App& command, Action& action);

}  // namespace shoal
