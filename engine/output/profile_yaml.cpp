#include "output/profile_yaml.h"

#include <fmt/format.h>
#include <yaml-cpp/yaml.h>

#include <algorithm>
#include <utility>

#include "core/diagnostic.h"
#include "output/text_quoting.h"

namespace shoal {

const YamlEntry* find_entry(const std::vector<YamlEntry>& entries, std::string_view key) {
  const auto found = std::ranges::find(entries, key, &YamlEntry::key);
  return found == entries.end() ? nullptr : &*found;
}

Result<ProfileYaml> ProfileYaml::parse(std::string path, std::string_view text) {
  ProfileYaml yaml(std::move(path), text);
  if (!is_utf8(text)) {
    return Error{ErrorCode::usage, "this is not UTF-8 text", yaml.path_, "save the file as UTF-8"};
  }
  try {
    yaml.root_ = YAML::Load(std::string(text));
  } catch (const YAML::Exception& exception) {
    return Error{ErrorCode::usage, "not YAML: " + exception.msg,
                 yaml.place(exception.mark.line + 1,
                            static_cast<std::size_t>(std::max(exception.mark.column, 0)) + 1),
                 "check indentation and quotes"};
  }
  if (yaml.root_.IsMap()) return yaml;
  return Error{ErrorCode::usage, "a profile is a mapping of keys to values", yaml.path_,
               "it begins with \"shoal_profile: 1\""};
}

std::string ProfileYaml::place(int line, std::size_t column) const {
  return fmt::format("{}:{}:{}", path_, line, column);
}

Error ProfileYaml::fault(const YAML::Node& node, std::string what, std::string hint,
                         std::size_t offset) const {
  const YAML::Mark mark = node.Mark();
  // A quote in front of the text stands between its place and its first byte.
  const std::string_view line = line_of(mark.line + 1);
  const auto column = static_cast<std::size_t>(std::max(mark.column, 0));
  const bool quoted = column < line.size() && (line[column] == '"' || line[column] == '\'');
  const std::size_t shift = offset + (quoted && offset > 0 ? 1 : 0);
  return Error{ErrorCode::usage, std::move(what), place(mark.line + 1, column + shift + 1),
               std::move(hint)};
}

std::string_view ProfileYaml::line_of(int number) const {
  std::string_view rest = text_;
  for (int i = 1; i < number && !rest.empty(); ++i) {
    rest.remove_prefix(std::min(rest.find('\n'), rest.size() - 1) + 1);
  }
  return rest.substr(0, rest.find('\n'));
}

Result<std::vector<YamlEntry>> ProfileYaml::entries(const YAML::Node& node, std::string_view what,
                                                    std::span<const std::string_view> known) const {
  if (!node.IsMap()) {
    return fault(node, fmt::format("{} must be a mapping of keys to values", what), "");
  }
  std::vector<YamlEntry> found;
  for (const auto& pair : node) {
    if (!pair.first.IsScalar()) return fault(pair.first, "a key must be a word", "");
    const std::string& key = pair.first.Scalar();
    if (find_entry(found, key)) {
      return fault(
          pair.first, fmt::format("the key \"{}\" is given twice", key),
          fmt::format("first on line {}", find_entry(found, key)->key_node.Mark().line + 1));
    }
    if (!known.empty() && std::ranges::find(known, key) == known.end()) {
      const std::string_view near = closest_match(key, known);
      return fault(pair.first, fmt::format("unknown key \"{}\" in {}", key, what),
                   near.empty() ? fmt::format("known here: {}", fmt::join(known, ", "))
                                : fmt::format("did you mean \"{}\"?", near));
    }
    found.push_back({key, pair.first, pair.second});
  }
  return found;
}

Result<std::string> ProfileYaml::scalar(const YamlEntry& entry) const {
  if (entry.value.IsScalar()) return entry.value.Scalar();
  return fault(entry.value, fmt::format("{} must be text", entry.key),
               "put text that begins with { or [ in quotes");
}

Result<std::vector<YAML::Node>> ProfileYaml::items(const YamlEntry& entry) const {
  if (entry.value.IsScalar()) return std::vector{entry.value};
  if (entry.value.IsSequence()) {
    return std::vector<YAML::Node>(entry.value.begin(), entry.value.end());
  }
  return fault(entry.value, fmt::format("{} must be a list", entry.key), "");
}

Error ProfileYaml::text_fault(const YamlEntry& entry, std::size_t offset, std::string what,
                              std::string hint) const {
  const std::string& text = entry.value.Scalar();
  const std::size_t begin = offset == 0 ? 0 : text.rfind('\n', offset - 1) + 1;
  const auto lines =
      std::count(text.begin(), text.begin() + static_cast<std::ptrdiff_t>(offset), '\n');
  const std::string_view line =
      std::string_view(text).substr(begin, text.find('\n', begin) - begin);
  const int number = entry.key_node.Mark().line + 2 + static_cast<int>(lines);
  const std::string_view in_file = line_of(number);
  if (line.empty() || !in_file.ends_with(line)) {
    return fault(entry.key_node, std::move(what), std::move(hint));
  }
  const std::size_t column = in_file.size() - line.size() + (offset - begin);
  return Error{ErrorCode::usage, std::move(what), place(number, column + 1), std::move(hint)};
}

}  // namespace shoal
