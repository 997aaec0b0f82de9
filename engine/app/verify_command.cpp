#include <fmt/format.h>

#include <memory>

#include "app/commands.h"
#include "app/interrupt.h"
#include "app/messages.h"
#include "batch/scheduler.h"
#include "batch/verify.h"
#include "core/terminal.h"

namespace shoal {
namespace {

struct VerifyCommand {
  std::string folder;
  bool recompute = false;
  int threads = 0;
};

int verify(const VerifyCommand& command) {
  VerifyOptions options;
  if (command.recompute) options.recompute = VerifyOptions::Recompute::yes;
  options.threads = command.threads > 0 ? command.threads : default_thread_count();
  const auto report = verify_outputs(command.folder, options, stop_on_interrupt());
  if (!report) {
    print_error(report.error());
    return report.error().code == ErrorCode::interrupted ? kExitInterrupted : kExitUsage;
  }
  for (const std::string& problem : report->problems) fmt::print("{}\n", printable(problem));
  fmt::print(stderr, "{} panoramas and {} written files compared{}, {} {}\n",
             report->panorama_count, report->output_count,
             command.recompute ? fmt::format(", {} projected again", report->recomputed_count) : "",
             report->problems.size(), report->problems.size() == 1 ? "problem" : "problems");
  return report->problems.empty() ? kExitOk : kExitFailed;
}

}  // namespace

void add_verify_options(CLI::App& command, Action& action) {
  auto options = std::make_shared<VerifyCommand>();
  command.add_option("OUT", options->folder, "The output folder of a run")->required();
  command.add_flag("--recompute", options->recompute,
                   "Project every panorama again; coefficients must be the same bits");
  command.add_option("-j,--threads", options->threads, "Workers; as many as processors by default")
      ->check(CLI::Range(1, 1024));
  command.callback([&action, options] { action = [options] { return verify(*options); }; });
}

}  // namespace shoal
