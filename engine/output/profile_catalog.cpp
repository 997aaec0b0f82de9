// Where profiles come from, and what is chosen of them.
#include <fmt/format.h>

#include <algorithm>
#include <span>
#include <utility>

#include "core/content_hash.h"
#include "core/diagnostic.h"
#include "core/input_file.h"
#include "output/builtin_profiles.h"
#include "output/profile.h"

namespace shoal {
namespace {

constexpr std::uint64_t kMaxBytes = std::uint64_t{1} << 20;

Result<Profile> read_profile(const std::filesystem::path& path) {
  SHOAL_ASSIGN_OR_RETURN(file, InputFile::open(path));
  if (file.size() > kMaxBytes) {
    return Error{ErrorCode::usage, "this is larger than a profile can be (1 MiB)", path.string(),
                 "a profile is a small YAML text"};
  }
  std::string text(file.size(), '\0');
  SHOAL_RETURN_IF_ERROR(file.read_exactly(0, std::as_writable_bytes(std::span(text))));
  return parse_profile(std::move(text), path);
}

Error no_such(std::string_view what, std::string_view name,
              std::span<const std::string_view> known) {
  const std::string_view near = closest_match(name, known);
  std::string hint = near.empty() ? fmt::format("there are {}", fmt::join(known, ", "))
                                  : fmt::format("did you mean \"{}\"?", near);
  if (known.empty()) hint = "leave it out";
  return Error{ErrorCode::usage, fmt::format("no {} \"{}\"", what, name), "", std::move(hint)};
}

Status choose(Profile& profile, const std::string& name, const std::string& word) {
  const auto option = std::ranges::find(profile.options, name, &ProfileOption::name);
  std::vector<std::string_view> known;
  if (option == profile.options.end()) {
    for (const ProfileOption& each : profile.options) known.push_back(each.name);
    return no_such("option of the profile " + profile.name + " is called", name, known);
  }
  const auto choice = std::ranges::find(option->choices, word, &ProfileOption::Choice::word);
  if (choice == option->choices.end()) {
    for (const auto& each : option->choices) known.push_back(each.word);
    return no_such("choice of " + name + " is called", word, known);
  }
  option->chosen = static_cast<std::size_t>(choice - option->choices.begin());
  return {};
}

template <typename T>
void replace(T& target, const std::optional<T>& change) {
  if (change) target = *change;
}

}  // namespace

std::span<const std::string_view> builtin_profile_names() {
  static const std::vector<std::string_view> kNames = [] {
    std::vector<std::string_view> names;
    for (const BuiltinProfile& profile : builtin_profiles()) names.push_back(profile.name);
    return names;
  }();
  return kNames;
}

Result<Profile> find_profile(const std::string& name_or_path) {
  for (const BuiltinProfile& profile : builtin_profiles()) {
    if (profile.name != name_or_path) continue;
    return parse_profile(std::string(profile.text), name_or_path + ".yaml");
  }
  const bool is_path = name_or_path.find('/') != name_or_path.npos ||
                       name_or_path.ends_with(".yaml") || name_or_path.ends_with(".yml");
  if (is_path) return read_profile(name_or_path);
  Error error = no_such("profile is called", name_or_path, builtin_profile_names());
  error.hint += "; a file of your own is named with its .yaml";
  return error;
}

Result<Profile> with_options(Profile profile,
                             std::span<const std::pair<std::string, std::string>> options) {
  for (const auto& [name, word] : options) SHOAL_RETURN_IF_ERROR(choose(profile, name, word));
  return profile;
}

ProfileConvention chosen_convention(const Profile& profile) {
  ProfileConvention convention = profile.convention;
  for (const ProfileOption& option : profile.options) {
    const ConventionChange& change = option.choices[option.chosen].change;
    replace(convention.frame, change.frame);
    replace(convention.sign, change.sign);
    replace(convention.quantity, change.quantity);
    replace(convention.basis, change.basis);
    replace(convention.scale, change.scale);
    replace(convention.light, change.light);
  }
  replace(convention.frame, profile.frame);
  return convention;
}

std::string profile_fingerprint(const Profile& profile) {
  std::string text = profile.name + "\n" + text_of(chosen_convention(profile).frame) + "\n";
  for (const ProfileOption& option : profile.options) {
    text += fmt::format("{} {}\n", option.name, option.chosen);
  }
  return hash_text(text + profile.data);
}

}  // namespace shoal
