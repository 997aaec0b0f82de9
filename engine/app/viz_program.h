// The commands that are those of another program, shoal-viz, so that this one starts without VTK.
#pragma once

#include <string_view>

namespace shoal {

[[nodiscard]] bool is_viz_command(std::string_view word);

// Becomes shoal-viz with the same arguments: the one beside this program, in its place in the build
// tree, or in PATH. Comes back, with an exit status, only where there is none, and says so.
// Precondition: argv is that of main().
[[nodiscard]] int become_viz(char** argv);

}  // namespace shoal
