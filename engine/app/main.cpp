#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <exception>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "app/commands.h"
#include "app/messages.h"
#include "app/viz_program.h"
#include "core/diagnostic.h"
#include "core/version.h"

namespace {

constexpr const char* kFooter =
    "A manifest (shoal: 1) can ask for, as manifests/README.md tells in full:\n"
    "  panoramas  file, files, exclude, name, tags; or light without a file: sky, lights\n"
    "             (ambient, directional, disk, cap, cosine), with a picture of it\n"
    "  pixels     degree, quadrature, layout (equirect, cube maps, angular map, mirror ball,\n"
    "             octahedral), layer, part, encoding, rgbe_decode, nonfinite, negative,\n"
    "             clamp (by value or percentile), sun\n"
    "  light      mirror, exposure, scale, matrix, white, rotate, dominant, window (hann, "
    "lanczos,\n"
    "             gauss, laplacian, auto: nothing negative), frame, quality\n"
    "  the whole  vars, include, output, defaults, variants (views: many turns), quantities,\n"
    "             tables (csv, json, npy, quality, lights), maps in every layout,\n"
    "             exports for engines, ZH3 and non-linear degree 1 among them (`shoal "
    "profiles`)\n\n"
    "Exit status: 0 all well; 1 a panorama failed or a check found something; 2 usage or manifest\n"
    "error, nothing run; 130 interrupted, finished work kept.\n";

struct Command {
  const char* name;
  const char* description;
  void (*add_options)(CLI::App& command, shoal::Action& action);  // null: shoal-viz has them
};
constexpr Command kCommands[] = {
    {"run", "Process what a manifest names (panoramas, skies, lights) and is not up to date",
     shoal::add_run_options},
    {"project", "Print the coefficients of panoramas; nothing is written",
     shoal::add_project_options},
    {"quality", "Print how well coefficients stand for panoramas, by Parseval or brute force",
     shoal::add_quality_options},
    {"check", "Validate a manifest; print the plan and why each panorama would run",
     shoal::add_check_options},
    {"init", "Write a commented manifest for a folder of panoramas", shoal::add_init_options},
    {"verify", "Hold the files of a run, read and written, against its store",
     shoal::add_verify_options},
    {"preview", "Shrink panoramas to small pictures", shoal::add_preview_options},
    {"view", "Look at a library's lighting in a window", nullptr},
    {"render", "Make a picture of a library's lighting; needs no display", nullptr},
    {"report", "Make a page of a library that opens in any browser", nullptr},
    {"profiles", "The engine profiles, or one of them whole", shoal::add_profiles_options},
    {"targets", "SIMD targets of this machine, best first", shoal::add_targets_options},
};

// Options are added to the command that is asked for alone: those of all cost every start 0.07 ms,
// a third of what is done between main() and the command.
void add_commands(CLI::App& app, std::span<char* const> words, shoal::Action& action) {
  for (const Command& command : kCommands) {
    CLI::App* added = app.add_subcommand(command.name, command.description);
    const auto is_its_name = [&](std::string_view word) { return word == command.name; };
    if (command.add_options && std::ranges::any_of(words, is_its_name)) {
      command.add_options(*added, action);
    }
  }
}

// A misspelt command; nothing where the word is one or an option.
std::optional<shoal::Error> unknown_command(std::string_view word) {
  std::vector<std::string_view> names;
  for (const Command& command : kCommands) names.emplace_back(command.name);
  return shoal::unknown_command(word, names);
}

// Runs the command; data that did not reach standard output is a failure, too.
int run(const shoal::Action& action) {
  int status = shoal::kExitFailed;
  try {
    status = action();
  } catch (const std::exception& exception) {
    shoal::print_error({shoal::ErrorCode::internal, exception.what(), "", ""});
  }
  if (status != shoal::kExitOk) return status;  // with the reason told
  errno = 0;
  if (std::fflush(stdout) == 0 && std::ferror(stdout) == 0) return status;
  const std::string reason = errno != 0 ? std::string(": ") + std::strerror(errno) : "";
  shoal::print_error(
      {shoal::ErrorCode::write_failed, "cannot be written" + reason, "standard output", ""});
  return shoal::kExitFailed;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc > 1 && shoal::is_viz_command(argv[1])) return shoal::become_viz(argv);
  CLI::App app("Turns libraries of HDR panoramas into spherical-harmonic lighting.", "shoal");
  app.set_version_flag("--version", fmt::format("shoal {}", shoal::kVersion));
  app.require_subcommand(1);
  app.footer(kFooter);
  shoal::Action action;
  add_commands(app, std::span(argv + 1, argv + std::max(argc, 1)), action);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    if (error.get_exit_code() != 0 && argc > 1) {
      if (const auto unknown = unknown_command(argv[1])) {
        shoal::print_error(*unknown);
        return shoal::kExitUsage;
      }
    }
    if (error.get_exit_code() == 0) return app.exit(error);  // --help and --version
    shoal::print_error({shoal::ErrorCode::usage, error.what(), "", "--help lists the options"});
    return shoal::kExitUsage;
  }
  return run(action);
}
