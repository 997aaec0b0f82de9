#include "batch/glob.h"

#include <fnmatch.h>
#include <locale.h>

#include <algorithm>
#include <system_error>
#include <utility>

namespace shoal {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kMaxCombinations = 1000;

Error bad_pattern(std::string what, std::string hint) {
  return {ErrorCode::usage, std::move(what), "", std::move(hint)};
}

// The index behind the character or escaped character at `i`.
std::size_t step(std::string_view pattern, std::size_t i) {
  return i + (pattern[i] == '\\' && i + 1 < pattern.size() ? 2 : 1);
}

// The index of the ']' that ends the bracket opened at `open`, or npos. A ']' right after the
// opening (or after its negation) stands for itself.
std::size_t bracket_end(std::string_view pattern, std::size_t open) {
  std::size_t i = open + 1;
  if (i < pattern.size() && (pattern[i] == '!' || pattern[i] == '^')) ++i;
  if (i < pattern.size() && pattern[i] == ']') ++i;
  while (i < pattern.size() && pattern[i] != ']' && pattern[i] != '/') i = step(pattern, i);
  return i < pattern.size() && pattern[i] == ']' ? i : std::string_view::npos;
}

bool is_wild(char c) { return c == '*' || c == '?' || c == '[' || c == '{'; }

// The index of the first wildcard, or the pattern's size.
std::size_t first_wildcard(std::string_view pattern) {
  std::size_t i = 0;
  while (i < pattern.size() && !is_wild(pattern[i])) i = step(pattern, i);
  return std::min(i, pattern.size());
}

std::string unescape(std::string_view pattern) {
  std::string text;
  for (std::size_t i = 0; i < pattern.size(); i = step(pattern, i)) {
    text += pattern[step(pattern, i) - 1];
  }
  return text;
}

// The alternatives of the brace opened at `open`, and the index behind its end.
struct Braces {
  std::vector<std::string_view> alternatives;
  std::size_t end = std::string_view::npos;
};

Braces read_braces(std::string_view pattern, std::size_t open) {
  Braces braces;
  int depth = 0;
  std::size_t start = open + 1;
  for (std::size_t i = open; i < pattern.size(); i = step(pattern, i)) {
    const char c = pattern[i];
    if (c == '{') ++depth;
    if (c == ',' && depth == 1) {
      braces.alternatives.push_back(pattern.substr(start, i - start));
      start = i + 1;
    }
    if (c == '}' && --depth == 0) {
      braces.alternatives.push_back(pattern.substr(start, i - start));
      braces.end = i + 1;
      return braces;
    }
  }
  return braces;
}

// The index of the first '{' outside brackets, or npos.
std::size_t first_brace(std::string_view pattern) {
  for (std::size_t i = 0; i < pattern.size(); i = step(pattern, i)) {
    if (pattern[i] == '{') return i;
    if (pattern[i] != '[') continue;
    const std::size_t end = bracket_end(pattern, i);
    if (end != std::string_view::npos) i = end;
  }
  return std::string_view::npos;
}

// Appends to `combinations` what `pattern` stands for once every brace is one of its alternatives.
Status expand_braces(const std::string& pattern, std::vector<std::string>& combinations) {
  const std::size_t open = first_brace(pattern);
  if (open == std::string::npos) {
    if (combinations.size() == kMaxCombinations) {
      return bad_pattern("the braces stand for more than 1000 patterns", "use a wildcard instead");
    }
    combinations.push_back(pattern);
    return {};
  }
  const Braces braces = read_braces(pattern, open);
  if (braces.end == std::string_view::npos) {
    return bad_pattern("a { has no closing }", "write \\{ for the character itself");
  }
  for (const std::string_view alternative : braces.alternatives) {
    SHOAL_RETURN_IF_ERROR(expand_braces(
        pattern.substr(0, open) + std::string(alternative) + pattern.substr(braces.end),
        combinations));
  }
  return {};
}

Status check_brackets(std::string_view pattern) {
  for (std::size_t i = 0; i < pattern.size(); i = step(pattern, i)) {
    if (pattern[i] != '[') continue;
    i = bracket_end(pattern, i);
    if (i == std::string_view::npos) {
      return bad_pattern("a [ has no closing ]", "write \\[ for the character itself");
    }
  }
  return {};
}

// The parts between slashes; empty ones and "." say nothing.
std::vector<std::string_view> split(std::string_view path) {
  std::vector<std::string_view> parts;
  while (!path.empty()) {
    const std::size_t slash = std::min(path.find('/'), path.size());
    const std::string_view part = path.substr(0, slash);
    if (!part.empty() && part != ".") parts.push_back(part);
    path.remove_prefix(std::min(slash + 1, path.size()));
  }
  return parts;
}

// fnmatch takes ? and [...] for characters of UTF-8 in the calling thread while this lives, for
// bytes where the system has no such locale.
class Utf8Locale {
 public:
  Utf8Locale() {
    static const locale_t utf8 = newlocale(LC_CTYPE_MASK, "C.UTF-8", nullptr);
    before_ = uselocale(utf8);
  }
  ~Utf8Locale() { uselocale(before_); }
  Utf8Locale(const Utf8Locale&) = delete;
  Utf8Locale& operator=(const Utf8Locale&) = delete;

 private:
  locale_t before_;
};

// An entry of a folder that the walk has still to do something with.
struct FolderEntry {
  std::string name;
  bool is_folder = false;
  bool is_link = false;
};

// Folders and what may be a picture: regular files, and links, dangling ones too, since a panorama
// whose link is broken should be told rather than left out.
std::vector<FolderEntry> read_folder(const fs::path& folder, std::error_code& error) {
  std::vector<FolderEntry> entries;
  fs::directory_iterator it(folder, error);
  for (; !error && it != fs::directory_iterator(); it.increment(error)) {
    std::error_code ignored;
    const bool is_link = it->is_symlink(ignored);
    const bool is_folder = it->is_directory(ignored);
    if (!is_folder && !is_link && !it->is_regular_file(ignored)) continue;
    entries.push_back({it->path().filename().string(), is_folder, is_link});
  }
  return entries;
}

}  // namespace

Result<Glob> Glob::parse(std::string_view pattern) {
  if (pattern.empty()) return bad_pattern("the pattern is empty", "");
  Glob glob;
  const std::size_t wildcard = first_wildcard(pattern);
  glob.has_wildcard_ = wildcard < pattern.size();
  glob.has_slash_ = pattern.find('/') != std::string_view::npos;
  const std::size_t slash = pattern.substr(0, wildcard).rfind('/');
  const std::size_t fixed = slash == std::string_view::npos ? 0 : slash + 1;
  glob.fixed_part_ = unescape(pattern.substr(0, fixed));

  std::vector<std::string> combinations;
  SHOAL_RETURN_IF_ERROR(expand_braces(std::string(pattern.substr(fixed)), combinations));
  for (const std::string& combination : combinations) {
    SHOAL_RETURN_IF_ERROR(glob.add_combination(combination));
  }
  return glob;
}

Status Glob::add_combination(std::string_view pattern) {
  SHOAL_RETURN_IF_ERROR(check_brackets(pattern));
  first_parts_.push_back(static_cast<int>(parts_.size()));
  for (const std::string_view part : split(pattern)) {
    if (part == "..") {
      return bad_pattern("\"..\" cannot follow a wildcard", "put it at the pattern's beginning");
    }
    if (part == "**") {
      parts_.push_back({Kind::any_folders, {}});
    } else if (first_wildcard(part) == part.size()) {
      parts_.push_back({Kind::name, unescape(part)});
    } else {
      parts_.push_back({Kind::wildcard, std::string(part)});
    }
  }
  // A ** at the end stands for the files in the folders, too.
  if (!parts_.empty() && parts_.back().kind == Kind::any_folders) {
    parts_.push_back({Kind::wildcard, "*"});
  }
  parts_.push_back({});
  return {};
}

// ** may stand for nothing, so whoever comes to it has come to what follows as well.
void Glob::add_state(States& states, int state) const {
  if (std::find(states.begin(), states.end(), state) == states.end()) states.push_back(state);
  if (parts_[state].kind == Kind::any_folders) add_state(states, state + 1);
}

Glob::States Glob::first_states() const {
  States states;
  for (const int first : first_parts_) add_state(states, first);
  return states;
}

Glob::States Glob::advance(const States& states, const std::string& name,
                           LinkedFolder linked) const {
  States next;
  for (const int state : states) {
    const Part& part = parts_[state];
    switch (part.kind) {
      case Kind::name:
        if (part.text == name) add_state(next, state + 1);
        break;
      case Kind::wildcard:
        if (fnmatch(part.text.c_str(), name.c_str(), FNM_PERIOD) == 0) add_state(next, state + 1);
        break;
      case Kind::any_folders:
        if (linked == LinkedFolder::no && name[0] != '.') add_state(next, state);
        break;
      case Kind::end:
        break;
    }
  }
  return next;
}

bool Glob::at_end(const States& states) const {
  return std::any_of(states.begin(), states.end(),
                     [this](int state) { return parts_[state].kind == Kind::end; });
}

bool Glob::goes_on(const States& states) const {
  return std::any_of(states.begin(), states.end(),
                     [this](int state) { return parts_[state].kind != Kind::end; });
}

bool Glob::matches(std::string_view path) const {
  if (!path.starts_with(fixed_part_)) return false;
  const Utf8Locale locale;
  States states = first_states();
  for (const std::string_view part : split(path.substr(fixed_part_.size()))) {
    states = advance(states, std::string(part), LinkedFolder::no);
  }
  return at_end(states);
}

bool Glob::selects(std::string_view path) const {
  if (has_slash_) return matches(path);
  const auto parts = split(path);
  return std::any_of(parts.begin(), parts.end(),
                     [this](std::string_view part) { return matches(part); });
}

GlobMatches Glob::expand(const fs::path& folder) const {
  GlobMatches matches;
  matches.root = (folder / fixed_part_).lexically_normal();
  if (has_wildcard_) {
    walk(matches);
    std::sort(matches.paths.begin(), matches.paths.end());
    return matches;
  }
  // Nothing to look for: a list of a million plain names must not read its folder a million times.
  std::error_code ignored;
  const std::string& name = parts_.front().text;
  const fs::file_status status = fs::symlink_status(matches.root / name, ignored);
  const bool is_link = fs::is_symlink(status);
  if (name.empty() || !(is_link || fs::is_regular_file(status))) return matches;
  if (is_link && fs::is_directory(matches.root / name, ignored)) return matches;
  matches.paths.push_back(name);
  return matches;
}

void Glob::walk(GlobMatches& matches) const {
  const Utf8Locale locale;
  std::vector<std::pair<std::string, States>> pending = {{"", first_states()}};
  while (!pending.empty()) {
    const auto [prefix, states] = std::move(pending.back());
    pending.pop_back();
    const fs::path folder = prefix.empty() ? matches.root : matches.root / prefix;
    std::error_code error;
    const std::vector<FolderEntry> entries = read_folder(folder.empty() ? "." : folder, error);
    if (error) matches.unreadable.push_back({folder.string(), error.message()});
    for (const FolderEntry& entry : entries) {
      const bool linked_folder = entry.is_folder && entry.is_link;
      States next =
          advance(states, entry.name, linked_folder ? LinkedFolder::yes : LinkedFolder::no);
      if (!entry.is_folder && at_end(next)) matches.paths.push_back(prefix + entry.name);
      if (entry.is_folder && goes_on(next)) {
        pending.emplace_back(prefix + entry.name + "/", std::move(next));
      }
    }
  }
}

}  // namespace shoal
