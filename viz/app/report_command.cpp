#include "report/report.h"

#include <fmt/format.h>

#include <memory>

#include "app/commands.h"
#include "app/common_options.h"
#include "app/messages.h"

namespace shoal::viz {
namespace {

struct ReportCommand {
  LibraryOptions library;
  std::string frame;
  std::string folder;
};

// Beside what it tells of, where that is a folder.
std::filesystem::path folder_of(const ReportCommand& command) {
  if (!command.folder.empty()) return command.folder;
  std::error_code code;
  const std::filesystem::path source = command.library.sources.front();
  return std::filesystem::is_directory(source, code) ? source / "report" : "report";
}

int report(const ReportCommand& command) {
  ReportSettings settings;
  settings.folder = folder_of(command);
  if (!command.frame.empty()) {
    const auto frame = parse_frame(command.frame);
    if (!frame) return report_error(frame.error());
    settings.frame = *frame;
  }
  const auto library = load_selected(command.library);
  if (!library) return report_error(library.error());
  PixelCache pixels(*library);
  Progress progress("reporting");
  const Status written =
      write_report(*library, pixels, settings,
                   [&](std::size_t done, std::size_t count) { progress.show(done, count); });
  if (!written) return report_error(written.error());
  fmt::print("{}\n", (settings.folder / "index.html").string());
  return kExitOk;
}

}  // namespace

void add_report_command(CLI::App& app, Action& action) {
  CLI::App* command =
      app.add_subcommand("report", "Make a page of a library that opens in any browser");
  auto options = std::make_shared<ReportCommand>();
  add_library_options(*command, options->library, Sources::needed);
  command->add_option("--frame", options->frame,
                      "Frame of coefficients and axes: a name, or where the panorama's centre, "
                      "right and up point; each panorama's in the library's tables by default");
  command->add_option("-o,--output", options->folder,
                      "Folder of the page; OUT/report by default where OUT is a folder");
  command->callback([&action, options] { action = [options] { return report(*options); }; });
}

}  // namespace shoal::viz
