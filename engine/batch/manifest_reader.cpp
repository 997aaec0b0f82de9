#include "batch/manifest_reader.h"

#include <charconv>
#include <cmath>
#include <system_error>

namespace shoal {
namespace {

// The number that `text` is as a whole. A plus in front is allowed, "inf" and "nan" are not.
template <typename T>
std::optional<T> parse_number(std::string_view text) {
  if (text.starts_with('+') && !text.starts_with("+-")) text.remove_prefix(1);
  T value{};
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size()) return std::nullopt;
  if (!std::isfinite(static_cast<double>(value))) return std::nullopt;
  return value;
}

// What to say of "1.5 EV" where "1.5" was wanted.
std::string unit_hint(std::string_view text) {
  double value = 0.0;
  const char* last = text.data() + text.size();
  const auto [end, error] = std::from_chars(text.data(), last, value);
  const bool is_number_first = error == std::errc() && std::isfinite(value) && end < last;
  return is_number_first ? "write the number alone, without a unit" : "";
}

}  // namespace

void ManifestReader::error(const YAML::Node& node, std::string message, std::string hint) const {
  log_->error(loc(node), std::move(message), std::move(hint));
}

std::string ManifestReader::shown(const YAML::Node& node) const {
  if (node.IsScalar()) return in_quotes(node.Scalar());
  if (node.IsSequence()) return "a list";
  return node.IsMap() ? "a mapping" : "nothing";
}

void ManifestReader::must_be(const Field& field, std::string_view what, std::string hint) const {
  error(field.value, fmt::format("{} must be {}, not {}", field.key, what, shown(field.value)),
        std::move(hint));
}

void ManifestReader::no_such_choice(const Field& field, const std::string& name,
                                    const std::vector<std::string_view>& names) const {
  std::string list;
  for (const std::string_view known : names) {
    if (!list.empty()) list += known == names.back() ? " or " : ", ";
    list += known;
  }
  error(field.value, fmt::format("{} must be {}, not {}", field.key, list, in_quotes(name)),
        did_you_mean(name, names));
}

std::optional<std::string> ManifestReader::text(const Field& field) const {
  if (!field.value.IsScalar()) {
    // {a,b}/*.hdr without quotes is a mapping for YAML, [ab].hdr a list.
    const bool is_bracket = field.value.IsMap() || field.value.IsSequence();
    must_be(field, "text", is_bracket ? "put text that begins with { or [ in quotes" : "");
    return std::nullopt;
  }
  return variables_->expand(field.value.Scalar(), loc(field.value), *log_);
}

std::optional<std::vector<YAML::Node>> ManifestReader::one_or_more(const Field& field) const {
  if (field.value.IsScalar()) return std::vector{field.value};
  return items(field, "text or a list of texts");
}

std::optional<std::vector<YAML::Node>> ManifestReader::items(const Field& field,
                                                             std::string_view what) const {
  if (!field.value.IsSequence()) {
    must_be(field, what);
    return std::nullopt;
  }
  return std::vector<YAML::Node>(field.value.begin(), field.value.end());
}

std::vector<LocatedText> ManifestReader::texts(const Field& field) const {
  std::vector<LocatedText> texts;
  const auto nodes = one_or_more(field);
  if (!nodes) return texts;
  for (const YAML::Node& node : *nodes) {
    std::optional<std::string> one = text(Field{field.key, field.key_node, node});
    if (one) texts.push_back({std::move(*one), loc(node)});
  }
  return texts;
}

std::optional<double> ManifestReader::number(const Field& field, const NumberRule& rule) const {
  if (!field.value.IsScalar()) {
    must_be(field, rule.what);
    return std::nullopt;
  }
  const std::optional<std::string> read = text(field);
  if (!read) return std::nullopt;
  const std::optional<double> value = parse_number<double>(*read);
  if (value && *value >= rule.minimum && *value <= rule.maximum) return value;
  error(field.value, fmt::format("{} must be {}, not {}", field.key, rule.what, in_quotes(*read)),
        unit_hint(*read));
  return std::nullopt;
}

std::optional<int> ManifestReader::integer(const Field& field, const IntegerRule& rule) const {
  const std::string what = fmt::format("a whole number from {} to {}", rule.minimum, rule.maximum);
  if (!field.value.IsScalar()) {
    must_be(field, what);
    return std::nullopt;
  }
  const std::optional<std::string> read = text(field);
  if (!read) return std::nullopt;
  const std::optional<int> value = parse_number<int>(*read);
  if (value && *value >= rule.minimum && *value <= rule.maximum) return value;
  error(field.value, fmt::format("{} must be {}, not {}", field.key, what, in_quotes(*read)));
  return std::nullopt;
}

std::optional<std::vector<double>> ManifestReader::numbers(const Field& field, std::size_t count,
                                                           const NumberRule& rule,
                                                           std::string_view what) const {
  const auto nodes = items(field, what);
  if (!nodes) return std::nullopt;
  if (nodes->size() != count) {
    error(field.value,
          fmt::format("{} must be {}, not a list of {}", field.key, what, nodes->size()));
    return std::nullopt;
  }
  std::vector<double> values;
  for (const YAML::Node& node : *nodes) {
    const auto value = number(Field{"an item of " + field.key, field.key_node, node}, rule);
    if (value) values.push_back(*value);
  }
  if (values.size() != count) return std::nullopt;
  return values;
}

std::optional<std::vector<Field>> ManifestReader::fields(const YAML::Node& node,
                                                         std::string_view what) const {
  std::vector<Field> fields;
  if (node.IsNull()) return fields;
  if (!node.IsMap()) {
    error(node, fmt::format("{} must be a mapping of keys to values, not {}", what, shown(node)));
    return std::nullopt;
  }
  for (const auto& pair : node) {
    if (!pair.first.IsScalar()) {
      error(pair.first, fmt::format("a key must be a word, not {}", shown(pair.first)));
      continue;
    }
    const std::string& key = pair.first.Scalar();
    const auto first = std::find_if(fields.begin(), fields.end(),
                                    [&key](const Field& field) { return field.key == key; });
    if (first == fields.end()) {
      fields.push_back({key, pair.first, pair.second});
    } else {
      error(pair.first, fmt::format("the key {} is given twice", in_quotes(key)),
            fmt::format("first on line {}", loc(first->key_node).line));
    }
  }
  return fields;
}

}  // namespace shoal
