#include <fmt/format.h>

#include <filesystem>
#include <memory>

#include "app/commands.h"
#include "app/messages.h"
#include "batch/init.h"
#include "core/atomic_file.h"

namespace shoal {
namespace {

int init(const std::string& folder) {
  const auto path = std::filesystem::path(folder) / kInitialManifestName;
  std::error_code ignored;
  if (std::filesystem::exists(path, ignored)) {
    print_error({ErrorCode::usage, "exists already; nothing was changed", path.string(),
                 "move it away first"});
    return kExitUsage;
  }
  const auto text = initial_manifest(folder);
  if (!text) {
    print_error(text.error());
    return kExitUsage;
  }
  if (const Status written = write_file_atomically(path, *text); !written) {
    print_error(written.error());
    return kExitFailed;
  }
  fmt::print("{}\n", path.string());
  fmt::print(stderr, "wrote {0}; next:\n  shoal check {0}\n  shoal run {0}\n", path.string());
  return kExitOk;
}

}  // namespace

void add_init_options(CLI::App& command, Action& action) {
  auto folder = std::make_shared<std::string>();
  command.add_option("DIR", *folder, "The folder; its manifest will be DIR/shoal.yaml")->required();
  command.callback([&action, folder] { action = [folder] { return init(*folder); }; });
}

}  // namespace shoal
