// ${name} and ${env:NAME} in the values of a manifest; $${ stands for ${ itself.
#pragma once

#include <map>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "batch/manifest_log.h"

namespace shoal {

class ManifestVariables {
 public:
  // `sets` come from the command line: they win over every definition and are taken literally.
  explicit ManifestVariables(std::vector<std::pair<std::string, std::string>> sets);

  // A later definition of the same name replaces an earlier one. `text` may refer to other
  // variables.
  void define(const std::string& name, std::string text, SourceLoc loc);

  // `text`, which begins at `loc`, with every reference replaced. Null, with errors in the log,
  // where one cannot be; a variable whose own definition is at fault is told by check() alone.
  [[nodiscard]] std::optional<std::string> expand(std::string_view text, const SourceLoc& loc,
                                                  ManifestLog& log);

  // Tells definitions that refer to themselves or to what is not there, and sets that no definition
  // and no value knows. To be called once, after all expansions.
  void check(ManifestLog& log);

  [[nodiscard]] static bool is_name(std::string_view text);

 private:
  struct Definition {
    std::string text;
    SourceLoc loc;
  };
  // The value of one reference, or null with `message` and `hint`; both empty where the fault is
  // told elsewhere.
  struct Lookup {
    std::optional<std::string> value;
    std::string message;
    std::string hint;
  };

  [[nodiscard]] Lookup look_up(std::string_view name);
  [[nodiscard]] Lookup look_up_definition(std::string_view name);
  [[nodiscard]] std::vector<std::string_view> names() const;

  std::map<std::string, std::string, std::less<>> sets_;
  std::map<std::string, Definition, std::less<>> definitions_;
  std::map<std::string, std::optional<std::string>, std::less<>> expanded_;  // kept, not redone
  std::set<std::string, std::less<>> asked_for_;
  std::vector<std::string> being_expanded_;  // from the value inwards
  bool outermost_met_again_ = false;         // the first of being_expanded_ refers to itself
};

}  // namespace shoal
