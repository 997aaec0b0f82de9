// The subcommands of shoal. Each adds itself to the parser and leaves in `action` what to do once
// the command line is understood; the action returns the exit status.
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

void add_run_command(CLI::App& app, Action& action);
void add_project_command(CLI::App& app, Action& action);
void add_check_command(CLI::App& app, Action& action);
void add_init_command(CLI::App& app, Action& action);
void add_verify_command(CLI::App& app, Action& action);
void add_targets_command(CLI::App& app, Action& action);

}  // namespace shoal
