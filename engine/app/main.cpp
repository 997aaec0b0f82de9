#include <fmt/format.h>

#include <clocale>

#include "app/commands.h"
#include "core/version.h"

namespace {

constexpr const char* kFooter =
    "Exit status: 0 all well; 1 a panorama failed or a check found something; 2 usage or manifest\n"
    "error, nothing run; 130 interrupted, finished work kept.";

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
    return app.exit(error) == 0 ? shoal::kExitOk : shoal::kExitUsage;
  }
  return action();
}
