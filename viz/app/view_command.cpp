#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <optional>
#include <string>

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

// What the window goes through: the panoramas that --panorama selects, and the one of --with.
struct Exhibition {
  Library library;
  std::optional<std::size_t> other;  // that of --with
};

Result<Exhibition> exhibition_of(const ViewCommand& command) {
  SHOAL_ASSIGN_OR_RETURN(library, load(command.library));
  SHOAL_ASSIGN_OR_RETURN(shown, select(library, command.library.panorama));
  SHOAL_ASSIGN_OR_RETURN(other, select_other(library, command.scene.with));
  if (!other) return Exhibition{part_of(library, shown), {}};
  auto place = std::ranges::find(shown, *other);
  if (place == shown.end()) place = shown.insert(place, *other);
  return Exhibition{part_of(library, shown), static_cast<std::size_t>(place - shown.begin())};
}

int view(const ViewCommand& command) {
  auto choice = understand(command.scene, command.library.degree);
  if (!choice) return report_error(choice.error());
  if (const Status display = check_display(); !display) {
    return report_error({ErrorCode::unsupported, display.error().what, "",
                         "`shoal render` makes pictures without a display"});
  }
  const auto exhibition = exhibition_of(command);
  if (!exhibition) return report_error(exhibition.error());
  if (command.scene.frame.empty()) choice->settings.frame = frame_of(exhibition->library);
  PixelCache pixels(exhibition->library);
  tell("h shows the keys, q quits");
  run_viewer(exhibition->library, pixels,
             {choice->scene, 0, exhibition->other, choice->settings, choice->size});
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
