// Typed values out of YAML nodes, and mappings by tables of keys. Whatever is wrong goes to the log
// with its place; a reader's answer is then nothing, and reading goes on.
#pragma once

#include <fmt/format.h>
#include <yaml-cpp/yaml.h>

#include <algorithm>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "batch/manifest_document.h"
#include "batch/manifest_log.h"
#include "batch/manifest_variables.h"

namespace shoal {

// One key of a mapping with its value.
struct Field {
  std::string key;
  YAML::Node key_node;
  YAML::Node value;
};

// A text with its place, for what is only found out later.
struct LocatedText {
  std::string text;
  SourceLoc loc;
};

// The numbers that a key takes. `what` completes "KEY must be ...".
struct NumberRule {
  double minimum;
  double maximum;
  std::string_view what;
};

struct IntegerRule {
  int minimum;
  int maximum;
};

template <typename E>
struct Choice {
  std::string_view name;
  E value;
};

class ManifestReader {
 public:
  ManifestReader(const ManifestDocument& document, ManifestVariables& variables, ManifestLog& log)
      : document_(&document), variables_(&variables), log_(&log) {}

  [[nodiscard]] const ManifestDocument& document() const { return *document_; }
  [[nodiscard]] SourceLoc loc(const YAML::Node& node) const { return document_->loc(node); }
  void error(const YAML::Node& node, std::string message, std::string hint = "") const;

  // A scalar with its variables replaced.
  [[nodiscard]] std::optional<std::string> text(const Field& field) const;
  // One scalar, or a list of them; nothing that is wrong among them is returned.
  [[nodiscard]] std::vector<LocatedText> texts(const Field& field) const;
  [[nodiscard]] std::optional<double> number(const Field& field, const NumberRule& rule) const;
  [[nodiscard]] std::optional<int> integer(const Field& field, const IntegerRule& rule) const;
  // A list of exactly `count` numbers. `what` completes "KEY must be ...".
  [[nodiscard]] std::optional<std::vector<double>> numbers(const Field& field, std::size_t count,
                                                           const NumberRule& rule,
                                                           std::string_view what) const;
  // The items of a list. `what` completes "KEY must be ...".
  [[nodiscard]] std::optional<std::vector<YAML::Node>> items(const Field& field,
                                                             std::string_view what) const;

  template <typename E>
  [[nodiscard]] std::optional<E> choice(const Field& field,
                                        std::span<const Choice<E>> table) const {
    const std::optional<std::string> name = text(field);
    if (!name) return std::nullopt;
    std::vector<std::string_view> names;
    for (const Choice<E>& known : table) {
      if (known.name == *name) return known.value;
      names.push_back(known.name);
    }
    no_such_choice(field, *name, names);
    return std::nullopt;
  }

  // A list of different choices, or a single one.
  template <typename E>
  [[nodiscard]] std::optional<std::vector<E>> choices(const Field& field,
                                                      std::span<const Choice<E>> table) const {
    const auto nodes = one_or_more(field);
    if (!nodes) return std::nullopt;
    std::vector<E> values;
    for (const YAML::Node& node : *nodes) {
      const std::optional<E> value = choice(Field{field.key, field.key_node, node}, table);
      if (!value) continue;
      if (std::find(values.begin(), values.end(), *value) != values.end()) {
        error(node, fmt::format("{} names {} twice", field.key, in_quotes(node.Scalar())));
      }
      values.push_back(*value);
    }
    return values;
  }

  // The fields of a mapping, each key once; a null stands for an empty one. `what` names the
  // mapping: "WHAT must be a mapping".
  [[nodiscard]] std::optional<std::vector<Field>> fields(const YAML::Node& node,
                                                         std::string_view what) const;

 private:
  [[nodiscard]] std::optional<std::vector<YAML::Node>> one_or_more(const Field& field) const;
  void no_such_choice(const Field& field, const std::string& name,
                      const std::vector<std::string_view>& names) const;
  void must_be(const Field& field, std::string_view what, std::string hint = "") const;
  [[nodiscard]] std::string shown(const YAML::Node& node) const;

  const ManifestDocument* document_;
  ManifestVariables* variables_;
  ManifestLog* log_;
};

}  // namespace shoal
