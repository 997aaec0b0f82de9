// Patterns over file names, and the files that they name.
//
//   *       any part of a name            **      any number of folders, also none
//   ?       one character                 {a,b}   one of several texts, which may hold all the
//   others [a-z]   one of several characters     \x      the character x itself
//
// As in a shell, names that begin with a dot are matched only by a pattern that spells the dot, and
// ** does not go through symbolic links to folders (every other part of a pattern does), so that a
// link to a folder above cannot lead round in circles.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "core/result.h"

namespace shoal {

struct UnreadableFolder {
  std::string path;
  std::string reason;
};

struct GlobMatches {
  std::filesystem::path root;      // the folder that `paths` are relative to
  std::vector<std::string> paths;  // files in bytewise order, '/' between folders
  std::vector<UnreadableFolder> unreadable;
};

class Glob {
 public:
  // Errors (usage): an empty pattern, a bracket or brace without its end, ".." after a wildcard,
  // more than 1000 combinations of braces.
  static Result<Glob> parse(std::string_view pattern);

  // The folders before the first wildcard: "" or something that ends in '/'.
  [[nodiscard]] const std::string& fixed_part() const { return fixed_part_; }

  // Whether `path` as a whole is what the pattern says.
  [[nodiscard]] bool matches(std::string_view path) const;

  // The same, but a pattern without '/' is content with any one part of `path`: *_thumb* selects
  // old/a_thumb.hdr, and old selects all that lies in a folder of that name.
  [[nodiscard]] bool selects(std::string_view path) const;

  // Regular files, and links to anything but a folder, below folder/fixed_part(). One walk,
  // whatever the number of combinations; no file is opened or asked for anything but the folders'
  // own entries.
  [[nodiscard]] GlobMatches expand(const std::filesystem::path& folder) const;

 private:
  enum class Kind { name, wildcard, any_folders, end };
  struct Part {
    Kind kind = Kind::end;
    std::string text;  // name: unescaped; wildcard: for fnmatch
  };
  // All combinations behind one another, each closed by an `end`. A state is an index into parts_.
  using States = std::vector<int>;
  enum class LinkedFolder { no, yes };

  Status add_combination(std::string_view pattern);
  void add_state(States& states, int state) const;
  [[nodiscard]] States first_states() const;
  [[nodiscard]] States advance(const States& states, const std::string& name,
                               LinkedFolder linked) const;
  [[nodiscard]] bool at_end(const States& states) const;
  [[nodiscard]] bool goes_on(const States& states) const;
  void walk(GlobMatches& matches) const;

  std::string fixed_part_;
  std::vector<Part> parts_;       // of what follows fixed_part_
  std::vector<int> first_parts_;  // where each combination begins
  bool has_wildcard_ = false;
  bool has_slash_ = false;
};

}  // namespace shoal
