#include "app/messages.h"

#include <fmt/format.h>
#include <unistd.h>

#include <cstdio>
#include <cstdlib>
#include <string>

#include "app/commands.h"

namespace shoal::viz {
namespace {

// More than this many would hide everything else.
constexpr std::size_t kMaxFailed = 10;

bool is_terminal() {
  const char* type = std::getenv("TERM");
  return ::isatty(STDERR_FILENO) && type && std::string_view(type) != "dumb";
}

// Control characters could do anything to a terminal.
std::string printable(std::string text) {
  for (char& c : text) {
    if (static_cast<unsigned char>(c) < ' ' || c == '\x7f') c = '?';
  }
  return text;
}

void print_line(const std::string& line) { fmt::print(stderr, "{}\n", printable(line)); }

}  // namespace

int report_error(const Error& error) {
  print_line("error: " + error.text());
  return error.code == ErrorCode::usage ? kExitUsage : kExitFailed;
}

void tell(const std::string& what) { print_line(what); }

void print_failed(const Library& library) {
  for (std::size_t i = 0; i < library.failed.size() && i < kMaxFailed; ++i) {
    print_line(fmt::format("warning: {} is left out: {}", library.failed[i].name,
                           library.failed[i].error));
  }
  if (library.failed.size() > kMaxFailed) {
    print_line(fmt::format("warning: and {} more", library.failed.size() - kMaxFailed));
  }
}

Progress::Progress(std::string_view what) : what_(what), on_terminal_(is_terminal()) {}

Progress::~Progress() {
  if (on_terminal_) fmt::print(stderr, "\r\x1b[K");
}

void Progress::show(std::size_t done, std::size_t count) {
  if (!on_terminal_) return;
  fmt::print(stderr, "\r\x1b[K{} {}/{}", what_, done, count);
  std::fflush(stderr);
}

}  // namespace shoal::viz
