#include <fmt/format.h>

#include <memory>

#include "app/commands.h"
#include "app/common_options.h"
#include "app/interrupt.h"
#include "app/messages.h"
#include "app/plan_listing.h"
#include "batch/run.h"

namespace shoal {
namespace {

struct RunCommand {
  ManifestOptions manifest;
  ComputeOptions compute;
  bool dry_run = false;
  bool explain = false;
  bool fail_fast = false;
  std::string progress = "auto";
};

void explain_plan(const Plan& plan) {
  for (const PlannedItem& item : plan.items) {
    if (item.work != ItemWork::none) {
      fmt::print(stderr, "runs: {} ({})\n", printable(item.entry->name), reason_of(item));
    }
  }
}

struct Prepared {
  Plan plan;
  Store store;
};

// The plan comes first: where it cannot be made, nothing is written at all.
Result<Prepared> prepare(const RunCommand& command, const Manifest& manifest) {
  SHOAL_ASSIGN_OR_RETURN(plan, plan_against_store(manifest, command.manifest));
  SHOAL_ASSIGN_OR_RETURN(store,
                         Store::open(manifest.output / kStoreFileName, Store::Access::write));
  if (command.explain) explain_plan(plan);
  return Prepared{std::move(plan), std::move(store)};
}

int run_prepared(Prepared& prepared, const RunCommand& command, const Manifest& manifest,
                 const ComputeChoice& choice, ProgressMode mode) {
  RunSettings settings;
  settings.threads = choice.threads;
  if (command.fail_fast) settings.on_failure = RunSettings::OnFailure::stop;
  Progress progress(mode);
  const Result<RunSummary> summary =
      run_plan(manifest, prepared.plan, prepared.store, settings, progress, stop_on_interrupt());
  if (!summary) {
    print_error(summary.error());
    return kExitFailed;
  }
  // The events have told programs all of it.
  if (mode != ProgressMode::json) {
    print_notes({summary->layouts, summary->warnings, summary->failures});
    print_summary(*summary, manifest);
  }
  if (summary->interrupted) return kExitInterrupted;
  return summary->failures.empty() ? kExitOk : kExitFailed;
}

int run(const RunCommand& command) {
  const Result<ComputeChoice> choice = understand(command.compute);
  const Result<ProgressMode> mode = parse_progress_mode(command.progress);
  if (!choice || !mode) {
    print_error(choice ? mode.error() : choice.error());
    return kExitUsage;
  }
  std::optional<Manifest> manifest = load_and_report(command.manifest);
  if (!manifest) return kExitUsage;
  if (const Status status = override_manifest(*choice, *manifest); !status) {
    print_error(status.error());
    return kExitUsage;
  }
  if (command.dry_run) return list_plan(*manifest, command.manifest);
  Result<Prepared> prepared = prepare(command, *manifest);
  if (!prepared) {
    print_error(prepared.error());
    return kExitUsage;
  }
  return run_prepared(*prepared, command, *manifest, *choice, *mode);
}

}  // namespace

void add_run_options(CLI::App& command, Action& action) {
  auto options = std::make_shared<RunCommand>();
  add_manifest_options(command, options->manifest);
  add_compute_options(command, options->compute);
  command
      .add_option("--format", options->compute.formats,
                  "Tables to write: csv, json, npy; may be repeated")
      ->allow_extra_args(false)
      ->check(CLI::IsMember({"csv", "json", "npy"}));
  command.add_flag("-n,--dry-run", options->dry_run, "Print the plan, do nothing");
  command.add_flag("--explain", options->explain, "Say why each panorama runs");
  command.add_flag("--fail-fast", options->fail_fast, "Stop at the first panorama that fails");
  command.add_option("--progress", options->progress, "auto, bar, plain, json or none");
  command.callback([&action, options] { action = [options] { return run(*options); }; });
}

}  // namespace shoal
