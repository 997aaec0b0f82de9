#include <fmt/format.h>

#include <exception>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "app/commands.h"
#include "app/messages.h"
#include "core/diagnostic.h"
#include "core/version.h"

namespace {

constexpr const char* kFooter =
    "Exit status: 0 all well; 1 something could not be read, drawn or written; 2 usage error,\n"
    "nothing done.\n";

// A misspelt command; nothing where the word is one or an option.
std::optional<shoal::Error> unknown_command(const CLI::App& app, std::string_view word) {
  std::vector<std::string> names;
  for (const CLI::App* command : app.get_subcommands({})) names.push_back(command->get_name());
  return shoal::unknown_command(word, std::vector<std::string_view>(names.begin(), names.end()));
}

int run(const shoal::viz::Action& action) {
  try {
    return action();
  } catch (const std::exception& exception) {
    return shoal::viz::report_error({shoal::ErrorCode::internal, exception.what(), "", ""});
  }
}

}  // namespace

int main(int argc, char** argv) {
  // `shoal render` becomes this program and leaves its own name here.
  const std::string name = std::filesystem::path(argc > 0 ? argv[0] : "").filename().string();
  CLI::App app("Shows the spherical-harmonic lighting of libraries of panoramas.",
               name.empty() ? "shoal-viz" : name);
  app.set_version_flag("--version", fmt::format("shoal-viz {}", shoal::kVersion));
  app.require_subcommand(1);
  app.footer(kFooter);
  shoal::viz::Action action;
  shoal::viz::add_view_command(app, action);
  shoal::viz::add_render_command(app, action);
  shoal::viz::add_report_command(app, action);
  shoal::viz::add_compare_command(app, action);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    if (error.get_exit_code() != 0 && argc > 1) {
      if (const auto unknown = unknown_command(app, argv[1])) {
        return shoal::viz::report_error(*unknown);
      }
    }
    if (error.get_exit_code() == 0) return app.exit(error);  // --help and --version
    return shoal::viz::report_error(
        {shoal::ErrorCode::usage, error.what(), "", "--help lists the options"});
  }
  return run(action);
}
