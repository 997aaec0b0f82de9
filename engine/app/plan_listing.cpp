#include "app/plan_listing.h"

#include <fmt/format.h>

#include "app/commands.h"
#include "app/messages.h"
#include "batch/input_files.h"
#include "core/terminal.h"

namespace shoal {
namespace {

std::string_view verb(ItemWork work) {
  switch (work) {
    case ItemWork::none:
      return "skip";
    case ItemWork::outputs:
      return "write";
    case ItemWork::all:
      return "project";
  }
  return "";
}

// ", LAYOUT" where it is known, before any file is opened, not to be equirect.
std::string layout_of(const PanoramaEntry& entry) {
  const Layout layout = entry.settings->projection.layout;
  if (entry.file.empty() || layout == Layout::equirect) return "";
  if (!is_one_file(entry)) return fmt::format(", {}", name_of(Layout::cube_faces));
  return layout == Layout::automatic ? "" : fmt::format(", {}", name_of(layout));
}

PlanOptions plan_options(const ManifestOptions& options) {
  PlanOptions plan;
  plan.only = options.only;
  if (options.force) plan.force = PlanOptions::Force::yes;
  if (options.verify_inputs) plan.inputs = PlanOptions::Inputs::by_content;
  return plan;
}

}  // namespace

Result<Plan> plan_against_store(const Manifest& manifest, const ManifestOptions& options) {
  auto store = Store::open(manifest.output / kStoreFileName, Store::Access::read);
  const bool is_first = !store && store.error().code == ErrorCode::not_found;
  if (!store && !is_first) return std::move(store).error();
  return make_plan(manifest, is_first ? nullptr : &*store, plan_options(options));
}

std::string reason_of(const PlannedItem& item) {
  return std::string(item.reason) + layout_of(*item.entry);
}

int list_plan(const Manifest& manifest, const ManifestOptions& options) {
  const Result<Plan> plan = plan_against_store(manifest, options);
  if (!plan) {
    print_error(plan.error());
    return kExitUsage;
  }
  for (const PlannedItem& item : plan->items) {
    fmt::print("{:<8} {}  ({})\n", verb(item.work), printable(item.entry->name), reason_of(item));
  }
  fmt::print("{} to project, {} to write files of, {} up to date; output in {}\n",
             plan->count(ItemWork::all), plan->count(ItemWork::outputs),
             plan->count(ItemWork::none), manifest.output.string());
  return kExitOk;
}

}  // namespace shoal
