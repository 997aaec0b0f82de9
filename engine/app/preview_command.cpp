#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <memory>
#include <string>
#include <string_view>
#include <thread>
#include <utility>
#include <vector>

#include "app/commands.h"
#include "app/in_order.h"
#include "app/interrupt.h"
#include "app/messages.h"
#include "batch/scheduler.h"
#include "output/text_quoting.h"
#include "transform/preview.h"

namespace shoal {
namespace {

constexpr int kMaxPreviewWidth = 1 << 14;

struct PreviewCommand {
  std::vector<std::string> files;
  std::string folder;
  std::string layout;
  int width = 256;
  int threads = 0;
  std::string format = "exr";
};

struct PreviewFormat {
  std::string_view name;
  MapFormat format;
  std::string_view extension;
};
constexpr PreviewFormat kFormats[] = {{"exr", MapFormat::exr_float, "exr"},
                                      {"exr-half", MapFormat::exr_half, "exr"},
                                      {"hdr", MapFormat::hdr, "hdr"}};

// How one file ended.
struct Outcome {
  std::string output;
  int width = 0;
  int height = 0;
  Layout layout = Layout::equirect;
  std::vector<std::string> warnings;
  Status status;
};

// Shrinks the files, a worker each at a time, and tells of them in their order.
class PreviewRun {
 public:
  PreviewRun(const PreviewCommand& command, const PreviewFormat& format, Layout layout,
             const std::atomic<bool>& stop)
      : command_(command),
        format_(format),
        settings_{command.width, layout},
        stop_(stop),
        outcomes_(command.files.size(),
                  [this](std::size_t index, const Outcome& outcome) { print(index, outcome); }) {}

  void run(int threads) {
    const auto work = [this] {
      while (!stop_) {
        const std::size_t index = next_++;
        if (index >= command_.files.size()) return;
        outcomes_.bring(index, shrink(index));
      }
    };
    std::vector<std::jthread> workers;
    const auto count = std::min(static_cast<std::size_t>(threads), command_.files.size());
    for (std::size_t i = 0; i < count; ++i) workers.emplace_back(work);
  }

  [[nodiscard]] const FileNotes& notes() const { return notes_; }

 private:
  // What a library throws ends one file, not the others.
  Outcome shrink(std::size_t index) {
    Outcome outcome;
    try {
      outcome.status = shrink(index, outcome);
    } catch (const std::exception& exception) {
      outcome.status = Error{ErrorCode::internal, std::string("unexpected: ") + exception.what(),
                             command_.files[index], "please report this"};
    }
    return outcome;
  }

  Status shrink(std::size_t index, Outcome& outcome) {
    SHOAL_ASSIGN_OR_RETURN(preview, make_preview(command_.files[index], {}, settings_, stop_));
    const std::filesystem::path output = std::filesystem::path(command_.folder) /
                                         fmt::format("{:06}.{}", index + 1, format_.extension);
    outcome.output = output.string();
    outcome.width = preview.width;
    outcome.height = preview.height;
    outcome.layout = preview.layout;
    outcome.warnings = std::move(preview.warnings);
    return write_preview(preview, format_.format, output);
  }

  void print(std::size_t index, const Outcome& outcome) {
    const std::string& file = command_.files[index];
    if (outcome.status) {
      fmt::print(
          "{{\"input\": {}, \"output\": {}, \"width\": {}, \"height\": {}, \"layout\": {}}}\n",
          json_quoted(file), json_quoted(outcome.output), outcome.width, outcome.height,
          json_quoted(name_of(outcome.layout)));
    } else if (outcome.status.error().code != ErrorCode::interrupted) {
      fmt::print("{{\"input\": {}, \"error\": {}}}\n", json_quoted(file),
                 json_quoted(outcome.status.error().text()));
    }
    if (!outcome.status) notes_.add_failure(file, outcome.status.error());
    notes_.add_warnings(file, outcome.warnings);
  }

  const PreviewCommand& command_;
  const PreviewFormat& format_;
  const PreviewSettings settings_;
  const std::atomic<bool>& stop_;
  std::atomic<std::size_t> next_{0};
  FileNotes notes_;
  InOrder<Outcome> outcomes_;
};

int preview(const PreviewCommand& command) {
  const PreviewFormat& format = *std::ranges::find(kFormats, command.format, &PreviewFormat::name);
  const Result<Layout> layout =
      command.layout.empty() ? Result<Layout>(Layout::equirect) : parse_layout(command.layout);
  if (!layout) {
    print_error(layout.error());
    return kExitUsage;
  }
  const std::atomic<bool>& stop = stop_on_interrupt();
  PreviewRun run(command, format, *layout, stop);
  run.run(command.threads > 0 ? command.threads : default_thread_count());
  print_notes(run.notes());
  if (stop) return kExitInterrupted;
  return run.notes().failures.empty() ? kExitOk : kExitFailed;
}

}  // namespace

void add_preview_options(CLI::App& command, Action& action) {
  auto options = std::make_shared<PreviewCommand>();
  command.add_option("FILE", options->files, "Panoramas")->required();
  command
      .add_option("-o,--output", options->folder,
                  "Folder for 000001.exr, 000002.exr ... in the order of FILE; a line of JSON each "
                  "on standard output says which is whose, and the layout it was taken for")
      ->required();
  command.add_option("--layout", options->layout,
                     "Layout of the panoramas, as for `project`; the pictures are equirect");
  command
      .add_option("--width", options->width,
                  "Of the pictures, 256 by default; never more than the panorama has. The height "
                  "is half of it")
      ->check(CLI::Range(1, kMaxPreviewWidth));
  command.add_option("-j,--threads", options->threads, "Workers; as many as processors by default")
      ->check(CLI::Range(1, 1024));
  command.add_option("--format", options->format, "exr (float, the default), exr-half or hdr")
      ->check(CLI::IsMember({"exr", "exr-half", "hdr"}));
  command.callback([&action, options] { action = [options] { return preview(*options); }; });
}

}  // namespace shoal
