// Ctrl-C: the first asks the run to stop after the bands at hand, the second ends the program at
// once.
#pragma once

#include <atomic>

namespace shoal {

// A flag that SIGINT and SIGTERM set. Calling it installs the handlers.
[[nodiscard]] std::atomic<bool>& stop_on_interrupt();

}  // namespace shoal
