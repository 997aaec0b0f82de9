#include "app/interrupt.h"

#include <csignal>

namespace shoal {
namespace {

std::atomic<bool> stop_requested{false};
static_assert(std::atomic<bool>::is_always_lock_free, "a signal handler may set it");

void request_stop(int) { stop_requested = true; }

}  // namespace

std::atomic<bool>& stop_on_interrupt() {
  struct sigaction action {};
  action.sa_handler = request_stop;
  // Reads and writes go on: the flag is looked at between bands.
  action.sa_flags = static_cast<int>(SA_RESETHAND) | SA_RESTART;
  sigemptyset(&action.sa_mask);
  sigaction(SIGINT, &action, nullptr);
  sigaction(SIGTERM, &action, nullptr);
  return stop_requested;
}

}  // namespace shoal
