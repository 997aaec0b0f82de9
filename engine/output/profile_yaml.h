// The YAML of a profile with the places of its parts, for messages about them.
#pragma once

#include <yaml-cpp/node/node.h>

#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/result.h"

namespace shoal {

// A key of a mapping with its value.
struct YamlEntry {
  std::string key;
  YAML::Node key_node;
  YAML::Node value;
};

// Null where no entry has the key.
[[nodiscard]] const YamlEntry* find_entry(const std::vector<YamlEntry>& entries,
                                          std::string_view key);

// All errors are usage, with file:line:column.
class ProfileYaml {
 public:
  // `text` must outlive this. Error: no UTF-8, no YAML, no mapping.
  static Result<ProfileYaml> parse(std::string path, std::string_view text);

  [[nodiscard]] const YAML::Node& root() const { return root_; }

  // An error about a node, or about the byte `offset` of its text.
  [[nodiscard]] Error fault(const YAML::Node& node, std::string what, std::string hint,
                            std::size_t offset = 0) const;

  // The same about a text of many lines. A block's lines stand below its key, each as in the file
  // but for the indentation; of a text in quotes only the key's place is known.
  [[nodiscard]] Error text_fault(const YamlEntry& entry, std::size_t offset, std::string what,
                                 std::string hint) const;

  // A mapping's entries, each key once and one of `known`, where that is not empty.
  Result<std::vector<YamlEntry>> entries(const YAML::Node& node, std::string_view what,
                                         std::span<const std::string_view> known) const;
  Result<std::string> scalar(const YamlEntry& entry) const;
  // The items of a list, or one text.
  Result<std::vector<YAML::Node>> items(const YamlEntry& entry) const;

 private:
  ProfileYaml(std::string path, std::string_view text) : path_(std::move(path)), text_(text) {}

  [[nodiscard]] std::string place(int line, std::size_t column) const;
  [[nodiscard]] std::string_view line_of(int number) const;

  std::string path_;
  std::string_view text_;
  YAML::Node root_;
};

}  // namespace shoal
