#include <fmt/format.h>

#include <memory>
#include <string>

#include "app/commands.h"
#include "app/messages.h"
#include "window/picture.h"
#include "window/picture_difference.h"

namespace shoal::viz {
namespace {

struct CompareCommand {
  std::string a;
  std::string b;
  double share = 0.0;
  std::string difference;
};

int compare(const CompareCommand& command) {
  const auto a = read_png(command.a);
  if (!a) return report_error(a.error());
  const auto b = read_png(command.b);
  if (!b) return report_error(b.error());
  const auto found = compare_pictures(*a, *b);
  if (!found) return report_error(found.error());
  fmt::print("largest {}, mean {:.4f}, share above {}: {:.6f}\n", found->largest, found->mean,
             kDifferenceThreshold, found->share);
  if (found->share <= command.share) return kExitOk;
  if (!command.difference.empty()) {
    const Status written = write_png(difference_picture(*a, *b), command.difference);
    if (!written) return report_error(written.error());
  }
  return kExitFailed;
}

}  // namespace

void add_compare_command(CLI::App& app, Action& action) {
  CLI::App* command = app.add_subcommand(
      "compare", "Say how far two pictures are apart; exit status 1 where they are too far");
  command->group("");  // for tests
  auto options = std::make_shared<CompareCommand>();
  command->add_option("A", options->a, "A picture, PNG")->required();
  command->add_option("B", options->b, "Another of the same size")->required();
  command
      ->add_option("--share", options->share,
                   fmt::format("Share of pixels that may differ by more than {} of 255 in a "
                               "channel; none by default",
                               kDifferenceThreshold))
      ->check(CLI::Range(0.0, 1.0));
  command->add_option("--difference", options->difference,
                      "Picture of the difference, eight times as strong; written where they are "
                      "too far apart");
  command->callback([&action, options] { action = [options] { return compare(*options); }; });
}

}  // namespace shoal::viz
