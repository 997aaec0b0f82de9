#include <fmt/format.h>

#include <cstdio>
#include <memory>
#include <string>

#include "app/commands.h"
#include "app/messages.h"
#include "output/profile.h"

namespace shoal {
namespace {

int print_profile(const std::string& name) {
  const Result<Profile> profile = find_profile(name);
  if (!profile) {
    print_error(profile.error());
    return kExitUsage;
  }
  std::fwrite(profile->data.data(), 1, profile->data.size(), stdout);
  return kExitOk;
}

int list_profiles() {
  fmt::print("{:<17} {:<6} {:<9} {}\n", "name", "degree", "frame", "consumer");
  for (const std::string_view name : builtin_profile_names()) {
    const Result<Profile> profile = find_profile(std::string(name));
    if (!profile) {
      print_error(profile.error());
      return kExitFailed;
    }
    fmt::print("{:<17} {:<6} {:<9} {}\n", name,
               profile->degree ? std::to_string(*profile->degree) : "all",
               text_of(chosen_convention(*profile).frame), profile->title);
  }
  return kExitOk;
}

}  // namespace

void add_profiles_options(CLI::App& command, Action& action) {
  auto name = std::make_shared<std::string>();
  command.add_option("NAME", *name, "Print this one: a built-in profile, or a file");
  command.callback([&action, name] {
    action = [name] { return name->empty() ? list_profiles() : print_profile(*name); };
  });
}

}  // namespace shoal
