#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <exception>
#include <string>
#include <string_view>
#include <vector>

#include "app/commands.h"
#include "app/messages.h"
#include "core/diagnostic.h"
#include "core/version.h"

namespace {

constexpr const char* kFooter =
    "Exit status: 0 all well; 1 a panorama failed or a check found something; 2 usage or manifest\n"
    "error, nothing run; 130 interrupted, finished work kept.\n";

// Tells a misspelt command with the one that was probably meant. False where the word is none.
bool suggest_command(const CLI::App& app, std::string_view word) {
  std::vector<std::string> names;
  for (const CLI::App* command : app.get_subcommands({})) names.push_back(command->get_name());
  const std::vector<std::string_view> candidates(names.begin(), names.end());
  if (word.starts_with("-") || std::ranges::find(names, word) != names.end()) return false;
  const std::string_view near = shoal::closest_match(word, candidates);
  fmt::print(stderr, "error: no command \"{}\"{}\n", word,
             near.empty() ? "" : fmt::format("; did you mean \"{}\"?", near));
  return true;
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
  CLI::App app("Turns libraries of HDR panoramas into spherical-harmonic lighting.", "shoal");
  app.set_version_flag("--version", fmt::format("shoal {}", shoal::kVersion));
  app.require_subcommand(1);
  app.footer(kFooter);
  shoal::Action action;
  shoal::add_run_command(app, action);
  shoal::add_project_command(app, action);
  shoal::add_check_command(app, action);
  shoal::add_init_command(app, action);
  shoal::add_verify_command(app, action);
  shoal::add_targets_command(app, action);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    if (error.get_exit_code() != 0 && argc > 1 && suggest_command(app, argv[1])) {
      return shoal::kExitUsage;
    }
    return app.exit(error) == 0 ? shoal::kExitOk : shoal::kExitUsage;
  }
  return run(action);
}
