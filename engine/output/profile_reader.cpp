// A profile out of its YAML text.
#include <fmt/format.h>
#include <yaml-cpp/yaml.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <utility>

#include "core/diagnostic.h"
#include "output/profile.h"
#include "output/profile_words.h"
#include "output/profile_yaml.h"

namespace shoal {
namespace {

constexpr std::string_view kVersion = "1";
constexpr int kBarePolynomialDegree = 2;

constexpr std::string_view kChoiceKeys[] = {"default", "choices"};
constexpr std::string_view kFrameKeys[] = {"center", "right", "up"};

// Reads one profile. Whatever is wrong comes back as the error of the first thing that is.
class ProfileReader {
 public:
  ProfileReader(ProfileYaml yaml, Profile profile)
      : yaml_(std::move(yaml)), profile_(std::move(profile)) {}

  Result<Profile> read();

 private:
  using Entries = std::vector<YamlEntry>;

  Status read_scalar(std::string_view key, std::string& target) const;
  Status read_texts(std::string_view key, std::vector<std::string>& target) const;
  template <typename E, std::size_t kCount>
  Result<E> word(const YamlEntry& entry, const Word<E> (&words)[kCount]) const;
  template <typename E, std::size_t kCount, typename T>
  Status read_word(const Entries& from, std::string_view key, const Word<E> (&words)[kCount],
                   T& target) const;

  Status check_keys();
  Status read_convention();
  Status read_degree();
  Status read_order();
  Status read_packing();
  Status read_options();
  Status read_text();
  Status check_file();
  Result<Frame> frame(const YamlEntry& entry) const;
  Result<std::vector<double>> scale(const YamlEntry& entry) const;
  Result<ConventionChange> change(const Entries& from) const;
  Result<ProfileOption> option(const YamlEntry& entry) const;
  Result<PackedList> list(const YamlEntry& entry) const;
  [[nodiscard]] const YamlEntry* find(std::string_view key) const { return find_entry(top_, key); }
  [[nodiscard]] int coefficient_limit() const {
    return coefficient_count(profile_.degree.value_or(kMaxDegree));
  }
  [[nodiscard]] Zonal zonal() const {
    return profile_.convention.light == ProfileLight::full ? Zonal::absent : Zonal::present;
  }

  ProfileYaml yaml_;
  Entries top_;
  Profile profile_;
};

Status ProfileReader::read_scalar(std::string_view key, std::string& target) const {
  const YamlEntry* entry = find(key);
  if (entry == nullptr) return {};
  SHOAL_ASSIGN_OR_RETURN(text, yaml_.scalar(*entry));
  target = std::move(text);
  return {};
}

// Texts that a file shows on one line each, whatever the YAML breaks them into.
Status ProfileReader::read_texts(std::string_view key, std::vector<std::string>& target) const {
  const YamlEntry* entry = find(key);
  if (entry == nullptr) return {};
  SHOAL_ASSIGN_OR_RETURN(nodes, yaml_.items(*entry));
  for (const YAML::Node& node : nodes) {
    SHOAL_ASSIGN_OR_RETURN(text, yaml_.scalar({entry->key, entry->key_node, node}));
    std::ranges::replace(text, '\n', ' ');
    target.push_back(std::move(text));
  }
  return {};
}

template <typename E, std::size_t kCount>
Result<E> ProfileReader::word(const YamlEntry& entry, const Word<E> (&words)[kCount]) const {
  SHOAL_ASSIGN_OR_RETURN(text, yaml_.scalar(entry));
  std::vector<std::string_view> names;
  for (const Word<E>& known : words) {
    if (known.name == text) return known.value;
    names.push_back(known.name);
  }
  const std::string_view near = closest_match(text, names);
  return yaml_.fault(
      entry.value,
      fmt::format("{} must be {}, not \"{}\"", entry.key, fmt::join(names, " or "), text),
      near.empty() ? "" : fmt::format("did you mean \"{}\"?", near));
}

template <typename E, std::size_t kCount, typename T>
Status ProfileReader::read_word(const Entries& from, std::string_view key,
                                const Word<E> (&words)[kCount], T& target) const {
  const YamlEntry* entry = find_entry(from, key);
  if (entry == nullptr) return {};
  SHOAL_ASSIGN_OR_RETURN(value, word(*entry, words));
  target = value;
  return {};
}

Status ProfileReader::check_keys() {
  SHOAL_ASSIGN_OR_RETURN(found, yaml_.entries(yaml_.root(), "a profile", kKeys));
  top_ = std::move(found);
  for (const std::string_view key :
       {"shoal_profile", "title", "consumer", "frame", "sign", "quantity", "degree"}) {
    if (find(key) != nullptr) continue;
    return yaml_.fault(yaml_.root(), fmt::format("a profile needs the key \"{}\"", key),
                       "manifests/profiles/README.md tells every key");
  }
  SHOAL_ASSIGN_OR_RETURN(version, yaml_.scalar(*find("shoal_profile")));
  if (version == kVersion) return {};
  return yaml_.fault(
      find("shoal_profile")->value,
      fmt::format("this shoal reads profiles of version {}, not \"{}\"", kVersion, version),
      "write \"shoal_profile: 1\"");
}

Result<Frame> ProfileReader::frame(const YamlEntry& entry) const {
  Result<Frame> parsed = Frame{};
  if (entry.value.IsMap()) {
    SHOAL_ASSIGN_OR_RETURN(axes, yaml_.entries(entry.value, "frame", kFrameKeys));
    std::array<std::string, 3> texts;
    for (std::size_t i = 0; i < texts.size(); ++i) {
      const YamlEntry* axis = find_entry(axes, kFrameKeys[i]);
      if (axis == nullptr) {
        return yaml_.fault(entry.value, fmt::format("frame needs \"{}\"", kFrameKeys[i]), "");
      }
      SHOAL_ASSIGN_OR_RETURN(text, yaml_.scalar(*axis));
      texts[i] = std::move(text);
    }
    parsed = parse_frame(texts[0], texts[1], texts[2]);
  } else {
    SHOAL_ASSIGN_OR_RETURN(text, yaml_.scalar(entry));
    parsed = parse_frame(text);
  }
  if (parsed) return parsed;
  return yaml_.fault(entry.value, parsed.error().what, parsed.error().hint);
}

Result<std::vector<double>> ProfileReader::scale(const YamlEntry& entry) const {
  SHOAL_ASSIGN_OR_RETURN(nodes, yaml_.items(entry));
  std::vector<double> factors;
  for (const YAML::Node& node : nodes) {
    SHOAL_ASSIGN_OR_RETURN(text, yaml_.scalar({"a factor of scale", entry.key_node, node}));
    const ParsedText<double> factor = parse_factor(text);
    if (!factor.ok()) return yaml_.fault(node, factor.message, factor.hint, factor.offset);
    factors.push_back(factor.value);
  }
  const std::size_t degrees = profile_.degree ? static_cast<std::size_t>(*profile_.degree) + 1 : 1;
  if (factors.size() == 1 || factors.size() == degrees) return factors;
  return yaml_.fault(entry.value,
                     fmt::format("scale has {} factors for {} degrees", factors.size(), degrees),
                     "give one for each degree, or one for all");
}

Result<ConventionChange> ProfileReader::change(const Entries& from) const {
  ConventionChange change;
  if (const YamlEntry* entry = find_entry(from, "frame")) {
    SHOAL_ASSIGN_OR_RETURN(value, frame(*entry));
    change.frame = value;
  }
  if (const YamlEntry* entry = find_entry(from, "scale")) {
    SHOAL_ASSIGN_OR_RETURN(value, scale(*entry));
    change.scale = std::move(value);
  }
  SHOAL_RETURN_IF_ERROR(read_word(from, "sign", kSigns, change.sign));
  SHOAL_RETURN_IF_ERROR(read_word(from, "quantity", kQuantities, change.quantity));
  SHOAL_RETURN_IF_ERROR(read_word(from, "basis", kBases, change.basis));
  SHOAL_RETURN_IF_ERROR(read_word(from, "light", kLights, change.light));
  if (change.light.value_or(ProfileLight::full) != ProfileLight::full && profile_.degree != 2) {
    return yaml_.fault(find_entry(from, "light")->value, "ZH3 is made of degree 2", "degree: 2");
  }
  if (change.basis == BasisConstant::premultiplied &&
      profile_.degree.value_or(kMaxDegree) > kBarePolynomialDegree) {
    return yaml_.fault(find_entry(from, "basis")->value,
                       "premultiplied constants are defined to degree 2",
                       "lower the degree, or use separate");
  }
  return change;
}

Status ProfileReader::read_convention() {
  SHOAL_ASSIGN_OR_RETURN(base, change(top_));
  ProfileConvention& convention = profile_.convention;
  convention.frame = *base.frame;
  convention.sign = *base.sign;
  convention.quantity = *base.quantity;
  convention.basis = base.basis.value_or(convention.basis);
  convention.scale = base.scale.value_or(convention.scale);
  convention.light = base.light.value_or(convention.light);
  return {};
}

Status ProfileReader::read_degree() {
  const YamlEntry& entry = *find("degree");
  SHOAL_ASSIGN_OR_RETURN(text, yaml_.scalar(entry));
  if (text == "all") return {};
  int degree = -1;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), degree);
  if (error != std::errc() || end != text.data() + text.size() || degree < 0 ||
      degree > kMaxDegree) {
    return yaml_.fault(entry.value,
                       fmt::format("degree must be a whole number from 0 to {} or all, not \"{}\"",
                                   kMaxDegree, text),
                       "");
  }
  profile_.degree = degree;
  return {};
}

Status ProfileReader::read_order() {
  const YamlEntry* entry = find("order");
  if (entry == nullptr) return {};
  SHOAL_ASSIGN_OR_RETURN(nodes, yaml_.items(*entry));
  if (!profile_.degree) {
    return yaml_.fault(entry->value, "an order needs a degree", "give degree a number");
  }
  for (const YAML::Node& node : nodes) {
    SHOAL_ASSIGN_OR_RETURN(text, yaml_.scalar({"an item of order", entry->key_node, node}));
    const ParsedText<PackedNumber> parsed = parse_packed_number(text, coefficient_limit());
    if (!parsed.ok())
      return yaml_.fault(node, parsed.message, "order: [sh0, sh3, sh1]", parsed.offset);
    const PackedNumber& number = parsed.value;
    if (number.size() != 1 || number[0].coefficient == kNoCoefficient || number[0].factor != 1.0 ||
        number[0].channel != kEachChannel) {
      return yaml_.fault(node, "order lists coefficients as they are",
                         "order: [sh0, sh3, sh1]; combinations go under packing");
    }
    if (std::ranges::find(profile_.order, number[0].coefficient) != profile_.order.end()) {
      return yaml_.fault(node, fmt::format("{} stands in the order already", text),
                         "order: [sh0, sh3, sh1]; each coefficient once");
    }
    profile_.order.push_back(number[0].coefficient);
  }
  return {};
}

Result<PackedList> ProfileReader::list(const YamlEntry& entry) const {
  if (!is_word(entry.key) || is_place(entry.key)) {
    return yaml_.fault(entry.key_node, fmt::format("\"{}\" cannot be a list's name", entry.key),
                       is_place(entry.key) ? "a text has a place of that name already"
                                           : "use letters, digits, - and _");
  }
  PackedList list{entry.key, {}};
  SHOAL_ASSIGN_OR_RETURN(nodes, yaml_.items(entry));
  for (const YAML::Node& node : nodes) {
    SHOAL_ASSIGN_OR_RETURN(text, yaml_.scalar({"a number of packing", entry.key_node, node}));
    ParsedText<PackedNumber> number = parse_packed_number(text, coefficient_limit(), zonal());
    if (!number.ok()) return yaml_.fault(node, number.message, number.hint, number.offset);
    list.numbers.push_back(std::move(number.value));
  }
  return list;
}

Status ProfileReader::read_packing() {
  const YamlEntry* entry = find("packing");
  if (entry == nullptr) return {};
  if (!profile_.degree) {
    return yaml_.fault(entry->value, "packing needs a degree", "give degree a number");
  }
  SHOAL_ASSIGN_OR_RETURN(lists, yaml_.entries(entry->value, "packing", {}));
  for (const YamlEntry& each : lists) {
    SHOAL_ASSIGN_OR_RETURN(packed, list(each));
    profile_.packing.push_back(std::move(packed));
  }
  return {};
}

Result<ProfileOption> ProfileReader::option(const YamlEntry& entry) const {
  SHOAL_ASSIGN_OR_RETURN(fields, yaml_.entries(entry.value, "an option", kChoiceKeys));
  const YamlEntry* choices = find_entry(fields, "choices");
  const YamlEntry* chosen = find_entry(fields, "default");
  if (choices == nullptr || chosen == nullptr || !is_word(entry.key)) {
    return yaml_.fault(entry.key_node, "an option is a word with a default and choices",
                       "NAME: {default: WORD, choices: {WORD: {quantity: irradiance}, ...}}");
  }
  ProfileOption option;
  option.name = entry.key;
  SHOAL_ASSIGN_OR_RETURN(words, yaml_.entries(choices->value, "choices", {}));
  for (const YamlEntry& each : words) {
    SHOAL_ASSIGN_OR_RETURN(keys, yaml_.entries(each.value, "a choice", kConventionKeys));
    SHOAL_ASSIGN_OR_RETURN(changed, change(keys));
    option.choices.push_back({each.key, std::move(changed)});
  }
  SHOAL_ASSIGN_OR_RETURN(word, yaml_.scalar(*chosen));
  const auto found = std::ranges::find(option.choices, word, &ProfileOption::Choice::word);
  if (found == option.choices.end()) {
    return yaml_.fault(chosen->value, fmt::format("\"{}\" is none of the choices", word), "");
  }
  option.chosen = static_cast<std::size_t>(found - option.choices.begin());
  return option;
}

Status ProfileReader::read_options() {
  const YamlEntry* entry = find("options");
  if (entry == nullptr) return {};
  SHOAL_ASSIGN_OR_RETURN(found, yaml_.entries(entry->value, "options", {}));
  for (const YamlEntry& each : found) {
    SHOAL_ASSIGN_OR_RETURN(parsed, option(each));
    profile_.options.push_back(std::move(parsed));
  }
  return {};
}

Status ProfileReader::read_text() {
  const YamlEntry* entry = find("text");
  if (entry == nullptr) return {};
  SHOAL_ASSIGN_OR_RETURN(text, yaml_.scalar(*entry));
  std::vector<std::string_view> options;
  for (const ProfileOption& option : profile_.options) options.push_back(option.name);
  auto parsed = parse_profile_text(text, profile_.packing, options);
  if (!parsed.ok()) {
    return yaml_.text_fault(*entry, parsed.offset, std::move(parsed.message),
                            std::move(parsed.hint));
  }
  profile_.text = std::move(parsed.value);
  return {};
}

bool shows_unknown(const Profile& profile) {
  return std::ranges::any_of(profile.text, [](const ProfileLine& line) {
    return std::ranges::any_of(line.pieces, [](const ProfilePiece& piece) {
      return piece.field == ProfileField::unknown || piece.field == ProfileField::unknowns_json;
    });
  });
}

// What decides over one another: form, text, extension, unknown.
Status ProfileReader::check_file() {
  const bool is_npy = profile_.form == ProfileForm::npy;
  if (is_npy) profile_.extension = "npy";
  SHOAL_RETURN_IF_ERROR(read_scalar("extension", profile_.extension));
  if (!is_word(profile_.extension)) {
    const YamlEntry* entry = find("extension");
    return yaml_.fault(entry ? entry->value : yaml_.root(),
                       "a profile needs the extension of its files", "extension: json");
  }
  if (is_npy) {
    for (const std::string_view key : {"text", "packing", "separator", "unknown"}) {
      if (const YamlEntry* entry = find(key)) {
        return yaml_.fault(entry->key_node, fmt::format("an npy file has no place for {}", key),
                           "leave it out, or use form: text");
      }
    }
    return {};
  }
  if (profile_.text.empty()) {
    return yaml_.fault(yaml_.root(), "a profile needs its text",
                       "text: | and the file below it, indented");
  }
  if (profile_.unknown.empty() || shows_unknown(profile_)) return {};
  return yaml_.fault(find("unknown")->key_node, "the text does not show what is unknown",
                     "give it a line with {{unknown}}, or {{json.unknown}} in JSON");
}

Result<Profile> ProfileReader::read() {
  SHOAL_RETURN_IF_ERROR(check_keys());
  SHOAL_RETURN_IF_ERROR(read_scalar("title", profile_.title));
  SHOAL_RETURN_IF_ERROR(read_scalar("consumer", profile_.consumer));
  std::ranges::replace(profile_.consumer, '\n', ' ');
  SHOAL_RETURN_IF_ERROR(read_scalar("separator", profile_.separator));
  SHOAL_RETURN_IF_ERROR(read_texts("sources", profile_.sources));
  SHOAL_RETURN_IF_ERROR(read_texts("unknown", profile_.unknown));
  SHOAL_RETURN_IF_ERROR(read_word(top_, "channels", kChannels, profile_.channels));
  SHOAL_RETURN_IF_ERROR(read_word(top_, "number", kNumbers, profile_.number));
  SHOAL_RETURN_IF_ERROR(read_word(top_, "form", kForms, profile_.form));
  SHOAL_RETURN_IF_ERROR(read_degree());
  SHOAL_RETURN_IF_ERROR(read_convention());
  SHOAL_RETURN_IF_ERROR(read_order());
  SHOAL_RETURN_IF_ERROR(read_packing());
  SHOAL_RETURN_IF_ERROR(read_options());
  SHOAL_RETURN_IF_ERROR(read_text());
  SHOAL_RETURN_IF_ERROR(check_file());
  return std::move(profile_);
}

}  // namespace

std::span<const std::string_view> profile_keys() { return kKeys; }

Result<Profile> parse_profile(std::string text, const std::filesystem::path& path) {
  Profile profile;
  profile.name = path.stem().string();
  profile.data = text;
  SHOAL_ASSIGN_OR_RETURN(yaml, ProfileYaml::parse(path.string(), text));
  return ProfileReader(std::move(yaml), std::move(profile)).read();
}

}  // namespace shoal
