#include <fmt/format.h>

#include <memory>
#include <string>
#include <utility>

#include "app/commands.h"
#include "app/common_options.h"
#include "app/messages.h"
#include "app/viewer.h"
#include "app/viewer_state.h"
#include "window/offscreen.h"

namespace shoal::viz {
namespace {

struct ViewCommand {
  LibraryOptions library;
  SceneOptions scene;
};

// Those that the pattern selects.
Result<Library> selected_library(const ViewCommand& command) {
  SHOAL_ASSIGN_OR_RETURN(library, load(command.library));
  SHOAL_ASSIGN_OR_RETURN(selected, select(library, command.library.panorama));
  Library part;
  part.title = library.title;
  for (const std::size_t panorama : selected) {
    part.panoramas.push_back(std::move(library.panoramas[panorama]));
  }
  return part;
}

int view(const ViewCommand& command) {
  const auto choice = understand(command.scene, command.library.degree);
  if (!choice) return report_error(choice.error());
  if (const Status display = check_display(); !display) {
    return report_error({ErrorCode::unsupported, display.error().what, "",
                         "`shoal render` makes pictures without a display"});
  }
  const auto library = selected_library(command);
  if (!library) return report_error(library.error());
  PixelCache pixels(*library);
  tell("h shows the keys, q quits");
  run_viewer(*library, pixels, {choice->scene, 0, choice->settings, choice->size});
  return kExitOk;
}

// The keys, below the options.
std::string footer() {
  std::string text = "Keys:";
  for (const KeyHelp& help : kKeyHelp) text += fmt::format("\n  {:8}{}", help.keys, help.meaning);
  return text;
}

}  // namespace

void add_view_command(CLI::App& app, Action& action) {
  CLI::App* command = app.add_subcommand("view", "Look at a library's lighting in a window");
  auto options = std::make_shared<ViewCommand>();
  add_library_options(*command, options->library, Sources::needed);
  add_scene_options(*command, options->scene);
  command->footer(footer());
  command->callback([&action, options] { action = [options] { return view(*options); }; });
}

}  // namespace shoal::viz
