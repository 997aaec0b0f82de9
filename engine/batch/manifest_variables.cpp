#include "batch/manifest_variables.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>

namespace shoal {
namespace {

constexpr std::size_t kMaxLength = std::size_t{64} << 10;

}  // namespace

ManifestVariables::ManifestVariables(std::vector<std::pair<std::string, std::string>> sets) {
  for (auto& [name, value] : sets) sets_.insert_or_assign(std::move(name), std::move(value));
}

void ManifestVariables::define(const std::string& name, std::string text, SourceLoc loc) {
  definitions_.insert_or_assign(name, Definition{std::move(text), std::move(loc)});
  expanded_.clear();
}

bool ManifestVariables::is_name(std::string_view text) {
  const auto is_word = [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' ||
           c == '-';
  };
  return !text.empty() && std::all_of(text.begin(), text.end(), is_word);
}

std::vector<std::string_view> ManifestVariables::names() const {
  std::vector<std::string_view> names;
  for (const auto& [name, value] : sets_) names.push_back(name);
  for (const auto& [name, definition] : definitions_) names.push_back(name);
  return names;
}

ManifestVariables::Lookup ManifestVariables::look_up(std::string_view name) {
  constexpr std::string_view kEnvironment = "env:";
  if (name.starts_with(kEnvironment)) {
    const std::string variable(name.substr(kEnvironment.size()));
    const char* value = std::getenv(variable.c_str());
    if (value) return {value, "", ""};
    return {std::nullopt, fmt::format("no environment variable {}", in_quotes(variable)),
            fmt::format("set it: {}=... shoal ...", variable)};
  }
  asked_for_.emplace(name);
  if (const auto set = sets_.find(name); set != sets_.end()) return {set->second, "", ""};
  if (definitions_.contains(name)) return look_up_definition(name);
  std::string hint = did_you_mean(name, names());
  if (hint.empty()) hint = fmt::format("define it under vars:, or use --set {}=VALUE", name);
  return {std::nullopt, fmt::format("no variable {}", in_quotes(name)), std::move(hint)};
}

ManifestVariables::Lookup ManifestVariables::look_up_definition(std::string_view name) {
  const auto& stack = being_expanded_;
  if (std::find(stack.begin(), stack.end(), name) != stack.end()) {
    outermost_met_again_ = outermost_met_again_ || stack.front() == name;
    return {};
  }
  if (const auto known = expanded_.find(name); known != expanded_.end()) {
    return {known->second, "", ""};
  }
  const Definition definition = definitions_.find(name)->second;
  being_expanded_.emplace_back(name);
  ManifestLog told_by_check;
  std::optional<std::string> value = expand(definition.text, definition.loc, told_by_check);
  being_expanded_.pop_back();
  expanded_.insert_or_assign(std::string(name), value);
  return {std::move(value), "", ""};
}

std::optional<std::string> ManifestVariables::expand(std::string_view text, const SourceLoc& loc,
                                                     ManifestLog& log) {
  std::string expanded;
  bool whole = true;
  for (std::size_t i = 0; i < text.size();) {
    const std::string_view rest = text.substr(i);
    if (rest.starts_with("$${")) {
      expanded += "${";
      i += 3;
      continue;
    }
    if (!rest.starts_with("${")) {
      expanded += text[i++];
      continue;
    }
    const std::size_t end = rest.find('}');
    if (end == std::string_view::npos) {
      log.error(log.find_in_line(loc, rest), "\"${\" without its \"}\"",
                "write \"$${\" for the characters themselves");
      return std::nullopt;
    }
    Lookup lookup = look_up(rest.substr(2, end - 2));
    whole = whole && lookup.value;
    if (lookup.value) expanded += *lookup.value;
    if (!lookup.message.empty()) {
      log.error(log.find_in_line(loc, rest.substr(0, end + 1)), lookup.message, lookup.hint);
    }
    i += end + 1;
    // Definitions that double one another grow without end.
    if (expanded.size() > kMaxLength) {
      log.error(loc, "the value grows beyond 64 KiB");
      return std::nullopt;
    }
  }
  if (!whole) return std::nullopt;
  return expanded;
}

void ManifestVariables::check(ManifestLog& log) {
  for (const auto& [name, definition] : definitions_) {
    if (sets_.contains(name)) continue;
    expanded_.clear();
    outermost_met_again_ = false;
    being_expanded_ = {name};
    (void)expand(definition.text, definition.loc, log);
    being_expanded_.clear();
    if (!outermost_met_again_) continue;
    log.error(definition.loc, fmt::format("the variable {} refers to itself", in_quotes(name)));
  }
  for (const auto& [name, value] : sets_) {
    if (asked_for_.contains(name) || definitions_.contains(name)) continue;
    std::vector<std::string_view> known;
    for (const auto& [defined, definition] : definitions_) known.push_back(defined);
    for (const std::string& asked : asked_for_) known.push_back(asked);
    log.error({"--set " + name}, fmt::format("the manifest knows no variable {}", in_quotes(name)),
              did_you_mean(name, known));
  }
}

}  // namespace shoal
