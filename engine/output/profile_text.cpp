// A profile's text taken apart.
#include "output/profile_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <utility>

#include "core/diagnostic.h"

namespace shoal {
namespace {

constexpr std::string_view kOpen = "{{";
constexpr std::string_view kClose = "}}";
constexpr std::string_view kChannelNames = "rgb";
constexpr std::string_view kNumbers = "numbers";

constexpr std::string_view kFacts[] = {"panorama", "variant", "profile", "title",
                                       "consumer", "frame",   "sign",    "quantity",
                                       "basis",    "degree",  "count",   "version"};

struct SimplePlace {
  std::string_view name;
  ProfileField field;
  LineRepeat repeat = LineRepeat::once;
  int channel = kEachChannel;
};
constexpr SimplePlace kSimplePlaces[] = {
    {"r", ProfileField::coefficient, LineRepeat::coefficients, 0},
    {"g", ProfileField::coefficient, LineRepeat::coefficients, 1},
    {"b", ProfileField::coefficient, LineRepeat::coefficients, 2},
    {"l", ProfileField::degree, LineRepeat::coefficients},
    {"m", ProfileField::order, LineRepeat::coefficients},
    {"i", ProfileField::index, LineRepeat::coefficients},
    {"n", ProfileField::position, LineRepeat::coefficients},
    {",", ProfileField::comma},
    {"unknown", ProfileField::unknown, LineRepeat::unknown},
    {"source", ProfileField::source, LineRepeat::sources},
    {"json.unknown", ProfileField::unknowns_json},
    {"json.sources", ProfileField::sources_json},
};

struct Place {
  ProfilePiece piece;
  LineRepeat repeat = LineRepeat::once;
};

std::string_view without_prefix(std::string_view name, std::string_view prefix) {
  return name.starts_with(prefix) ? name.substr(prefix.size()) : std::string_view();
}

class TextReader {
 public:
  TextReader(std::string_view text, std::span<const PackedList> lists,
             const std::vector<std::string_view>& options)
      : text_(text), lists_(lists), options_(options) {}

  ParsedText<std::vector<ProfileLine>> read() {
    for (std::size_t begin = 0; begin < text_.size() && parsed_.ok();) {
      const std::size_t end = std::min(text_.find('\n', begin), text_.size());
      read_line(begin, end);
      begin = end + 1;
    }
    return std::move(parsed_);
  }

 private:
  void fail(std::size_t offset, std::string message, std::string hint) {
    if (!parsed_.ok()) return;
    parsed_.message = std::move(message);
    parsed_.hint = std::move(hint);
    parsed_.offset = offset;
  }

  void read_line(std::size_t begin, std::size_t end) {
    ProfileLine line;
    std::size_t at = begin;
    while (at < end && parsed_.ok()) {
      const std::size_t open = std::min(text_.find(kOpen, at), end);
      if (open > at) {
        ProfilePiece literal;
        literal.text = text_.substr(at, open - at);
        line.pieces.push_back(std::move(literal));
      }
      at = open == end ? end : read_place(open, end, line);
    }
    parsed_.value.push_back(std::move(line));
  }

  // Returns where the text goes on.
  std::size_t read_place(std::size_t open, std::size_t end, ProfileLine& line) {
    const std::size_t close = text_.find(kClose, open);
    if (close >= end) {
      fail(open, "this {{ is not closed on its line", "places look like {{r}} or {{panorama}}");
      return end;
    }
    const std::string_view name = text_.substr(open + 2, close - open - 2);
    std::optional<Place> place = find_place(name);
    if (!place) {
      tell_unknown(open, name);
      return end;
    }
    if (place->repeat != LineRepeat::once) {
      if (line.repeat != LineRepeat::once && line.repeat != place->repeat) {
        fail(open, "a line is repeated for coefficients, for unknown or for sources, not for two",
             "put them on lines of their own");
      }
      line.repeat = place->repeat;
    }
    line.pieces.push_back(std::move(place->piece));
    return close + kClose.size();
  }

  [[nodiscard]] std::optional<Place> find_place(std::string_view name) const {
    for (const SimplePlace& simple : kSimplePlaces) {
      if (simple.name != name) continue;
      ProfilePiece piece;
      piece.field = simple.field;
      piece.channel = simple.channel;
      return Place{std::move(piece), simple.repeat};
    }
    if (auto piece = find_fact(name)) return Place{std::move(*piece)};
    if (auto piece = find_numbers(name)) return Place{std::move(*piece)};
    return std::nullopt;
  }

  [[nodiscard]] std::optional<ProfilePiece> find_fact(std::string_view name) const {
    ProfilePiece piece;
    if (name.starts_with("json.")) {
      piece.quoting = Quoting::json;
      name = without_prefix(name, "json.");
    }
    const std::string_view option = without_prefix(name, "option.");
    piece.field = option.empty() ? ProfileField::fact : ProfileField::option;
    piece.text = option.empty() ? name : option;
    const bool known = option.empty() ? std::ranges::find(kFacts, name) != std::end(kFacts)
                                      : std::ranges::find(options_, option) != options_.end();
    return known ? std::optional(std::move(piece)) : std::nullopt;
  }

  // {{numbers}}, {{LIST}}, and either with the channel behind a dot.
  [[nodiscard]] std::optional<ProfilePiece> find_numbers(std::string_view name) const {
    ProfilePiece piece;
    const std::size_t dot = name.rfind('.');
    if (dot != name.npos && name.size() == dot + 2) {
      const std::size_t channel = kChannelNames.find(name[dot + 1]);
      if (channel == kChannelNames.npos) return std::nullopt;
      piece.channel = static_cast<int>(channel);
      name = name.substr(0, dot);
    }
    if (name == kNumbers) {
      piece.field = ProfileField::numbers;
      return piece;
    }
    const auto list = std::ranges::find(lists_, name, &PackedList::name);
    const bool told_channel = piece.channel != kEachChannel;
    if (list == lists_.end() || list->has_channels() != told_channel) return std::nullopt;
    piece.field = ProfileField::list;
    piece.list = static_cast<std::size_t>(list - lists_.begin());
    return piece;
  }

  void tell_unknown(std::size_t open, std::string_view name) {
    const std::string_view plain = name.substr(0, name.find('.'));
    const auto list = std::ranges::find(lists_, plain, &PackedList::name);
    if (list != lists_.end()) {
      return fail(open, fmt::format("the list \"{}\" cannot stand here as {{{{{}}}}}", plain, name),
                  list->has_channels()
                      ? fmt::format("say of which channel: {{{{{}.r}}}}", plain)
                      : fmt::format("it names its channels itself: {{{{{}}}}}", plain));
    }
    std::vector<std::string_view> known(std::begin(kFacts), std::end(kFacts));
    for (const SimplePlace& simple : kSimplePlaces) known.push_back(simple.name);
    for (const PackedList& each : lists_) known.push_back(each.name);
    known.push_back(kNumbers);
    const std::string_view near = closest_match(name, known);
    fail(open, fmt::format("nothing is called \"{}\" here", name),
         near.empty() ? "the README of profiles lists what a text may hold"
                      : fmt::format("did you mean {{{{{}}}}}?", near));
  }

  std::string_view text_;
  std::span<const PackedList> lists_;
  const std::vector<std::string_view>& options_;
  ParsedText<std::vector<ProfileLine>> parsed_;
};

}  // namespace

std::span<const std::string_view> profile_facts() { return kFacts; }

bool is_place(std::string_view name) {
  return name == kNumbers || std::ranges::find(kFacts, name) != std::end(kFacts) ||
         std::ranges::find(kSimplePlaces, name, &SimplePlace::name) != std::end(kSimplePlaces);
}

ParsedText<std::vector<ProfileLine>> parse_profile_text(
    std::string_view text, std::span<const PackedList> lists,
    const std::vector<std::string_view>& options) {
  return TextReader(text, lists, options).read();
}

}  // namespace shoal
