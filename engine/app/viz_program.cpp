#include "app/viz_program.h"

#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <string>
#include <system_error>

#include "app/commands.h"
#include "app/messages.h"

namespace shoal {
namespace {

constexpr const char* kProgram = "shoal-viz";

// Returns only where the program cannot be started.
void become(const std::filesystem::path& program, char** argv) { ::execv(program.c_str(), argv); }

}  // namespace

bool is_viz_command(std::string_view word) {
  return word == "view" || word == "render" || word == "report";
}

int become_viz(char** argv) {
  std::error_code code;
  const auto own = std::filesystem::read_symlink("/proc/self/exe", code);
  if (!code) {
    become(own.parent_path() / kProgram, argv);
    become(own.parent_path() / "../../viz/app" / kProgram, argv);
  }
  ::execvp(kProgram, argv);
  const std::string why =
      errno == ENOENT ? "this shoal was built without it" : std::strerror(errno);
  print_error({ErrorCode::not_found,
               std::string("`shoal ") + argv[1] + "` needs the program shoal-viz: " + why, "",
               "it is built together with shoal where VTK 9.1 and EGL are installed: libvtk9-dev, "
               "libegl-dev"});
  return kExitFailed;
}

}  // namespace shoal
