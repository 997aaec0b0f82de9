// The subcommands of shoal-viz. Each adds itself to the parser and leaves in `action` what to do
// once the command line is understood; the action returns the exit status.
#pragma once

#include <CLI/CLI.hpp>
#include <functional>

namespace shoal::viz {

// What the program's exit status says.
enum ExitStatus : int {
  kExitOk = 0,
  kExitFailed = 1,  // something could not be read, drawn or written
  kExitUsage = 2,   // nothing was done: the command line is wrong
};

using Action = std::function<int()>;

void add_view_command(CLI::App& app, Action& action);
void add_render_command(CLI::App& app, Action& action);
void add_report_command(CLI::App& app, Action& action);
void add_compare_command(CLI::App& app, Action& action);  // of pictures; for tests

}  // namespace shoal::viz
