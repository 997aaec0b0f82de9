#include <fmt/format.h>

#include "app/commands.h"
#include "kernels/targets.h"

namespace shoal {

void add_targets_command(CLI::App& app, Action& action) {
  CLI::App* command = app.add_subcommand("targets", "SIMD targets of this machine, best first");
  command->callback([&action] {
    action = [] {
      for (const std::string& target : kernels::available_targets()) {
        fmt::print("{}{}\n", target, target == kernels::active_target() ? " (active)" : "");
      }
      return kExitOk;
    };
  });
}

}  // namespace shoal
