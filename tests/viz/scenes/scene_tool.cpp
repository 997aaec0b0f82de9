// Draws a scene of the made library, or writes its lobes, for tests that are scripts:
//   scene_tool picture WAY SCENE WIDTH HEIGHT OUT.png    WAY is surfaceless or x_display
//   scene_tool lobes FRAME OUT.glb
#include <cstdio>
#include <cstdlib>
#include <string>

#include "scenes/lobe_export.h"
#include "scenes/scene.h"
#include "viz/scenes/made_library.h"
#include "window/offscreen.h"

namespace shoal::viz {
namespace {

Status draw(const SceneInput& input, char** arguments) {
  const bool x = std::string(arguments[0]) == "x_display";
  SHOAL_ASSIGN_OR_RETURN(kind, parse_scene(arguments[1]));
  SHOAL_ASSIGN_OR_RETURN(
      window, make_offscreen_window({std::atoi(arguments[2]), std::atoi(arguments[3])},
                                    x ? OffscreenWay::x_display : OffscreenWay::surfaceless));
  SHOAL_RETURN_IF_ERROR(show_scene(kind, input, *window));
  return write_png(take_picture(*window), arguments[4]);
}

Status run(int count, char** arguments) {
  const Library library = test::made_library();
  PixelCache pixels(library);
  SceneInput input{&library, 0, std::size_t{1}, {}, &pixels};  // compares the two panoramas
  const std::string job = count > 1 ? arguments[1] : "";
  if (job == "picture" && count == 7) return draw(input, arguments + 2);
  if (job == "lobes" && count == 4) {
    SHOAL_ASSIGN_OR_RETURN(frame, parse_frame(arguments[2]));
    input.settings.frame = frame;
    return write_lobes(input, arguments[3]);
  }
  return Error{ErrorCode::usage, "picture WAY SCENE WIDTH HEIGHT OUT, or lobes FRAME OUT", "", ""};
}

}  // namespace
}  // namespace shoal::viz

int main(int count, char** arguments) {
  const auto status = shoal::viz::run(count, arguments);
  if (!status) std::fprintf(stderr, "%s\n", status.error().text().c_str());
  return status ? 0 : 1;
}
