#include "app/messages.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <iterator>
#include <string>

#include "app/commands.h"
#include "core/terminal.h"

namespace shoal::viz {
namespace {

// More than this many would hide everything else.
constexpr std::size_t kMaxFailed = 10;

}  // namespace

int report_error(const Error& error) {
  print_message(Style::red, "error:", error.text());
  return error.code == ErrorCode::usage ? kExitUsage : kExitFailed;
}

void tell(const std::string& what) { fmt::print(stderr, "{}\n", printable(what)); }

void print_failed(const Library& library) {
  for (std::size_t i = 0; i < library.failed.size() && i < kMaxFailed; ++i) {
    print_message(Style::yellow,
                  "warning:", library.failed[i].name + " is left out: " + library.failed[i].error);
  }
  if (library.failed.size() > kMaxFailed) {
    print_message(Style::yellow,
                  "warning:", fmt::format("and {} more", library.failed.size() - kMaxFailed));
  }
}

void print_frameless(const Library& library) {
  for (const auto& table : library.frameless) {
    print_message(Style::yellow, "warning:",
                  table.string() +
                      ": a CSV table does not tell its frame; it is taken for native "
                      "(--table-frame names another, and a JSON table tells it)");
  }
}

void print_lesser_degrees(const Library& library, int degree) {
  const auto is_lesser = [&](const Panorama& panorama) {
    return panorama.coefficients.degree < degree;
  };
  Library lesser;
  std::ranges::copy_if(library.panoramas, std::back_inserter(lesser.panoramas), is_lesser);
  if (lesser.panoramas.empty()) return;
  const Panorama& first = lesser.panoramas.front();
  const std::string who =
      lesser.panoramas.size() == 1
          ? fmt::format(": {} ends at degree {}", full_name(first), first.coefficients.degree)
          : fmt::format(" is beyond {}, such as {} at {}", count_text(lesser), full_name(first),
                        first.coefficients.degree);
  print_message(Style::yellow,
                "warning:", fmt::format("--degree {}{}; all that there is is shown", degree, who));
}

Progress::Progress(std::string_view what)
    : what_(what), on_terminal_(terminal_of(STDERR_FILENO).kind == Terminal::Kind::interactive) {}

Progress::~Progress() {
  if (on_terminal_) fmt::print(stderr, "\r\x1b[K");
}

void Progress::show(std::size_t done, std::size_t count) {
  if (!on_terminal_) return;
  fmt::print(stderr, "\r\x1b[K{} {}/{}", what_, done, count);
  std::fflush(stderr);
}

}  // namespace shoal::viz
