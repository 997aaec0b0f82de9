#include <fmt/format.h>

#include "app/commands.h"
#include "kernels/targets.h"

namespace shoal {

void add_targets_options(CLI::App& command, Action& action) {
  command.callback([&action] {
    action = [] {
      for (const std::string& target : kernels::available_targets()) {
        fmt::print("{}{}\n", target, target == kernels::active_target() ? " (active)" : "");
      }
      return kExitOk;
    };
  });
}

}  // namespace shoal
