#include <memory>

#include "app/commands.h"
#include "app/common_options.h"
#include "app/messages.h"
#include "app/plan_listing.h"

namespace shoal {
namespace {

int check(const ManifestOptions& options) {
  const std::optional<Manifest> manifest = load_and_report(options);
  if (!manifest) return kExitUsage;
  return list_plan(*manifest, options);
}

}  // namespace

void add_check_options(CLI::App& command, Action& action) {
  auto options = std::make_shared<ManifestOptions>();
  add_manifest_options(command, *options);
  command.callback([&action, options] { action = [options] { return check(*options); }; });
}

}  // namespace shoal
