// The names of panoramas: unique, and safe as paths below the output folder.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "batch/manifest.h"
#include "batch/manifest_log.h"

namespace shoal {

// What is wrong with a name, or "". A name is a relative path with '/' between its parts, none of
// them empty, "." or "..", without control characters.
[[nodiscard]] std::string name_fault(std::string_view name);

// Takes the panoramas one after the other, then names all of them.
class PanoramaNames {
 public:
  // A panorama with a name: of its own, told at `loc`. Whether it is safe is for the caller to
  // check.
  void add_given(std::string name, SourceLoc loc);

  // A panorama named by its path without extension. The extension stays where two such names would
  // be equal.
  void add_path(std::string path);

  // Writes the names into the panoramas, in the order in which they were added. Tells paths that
  // are not safe as names, and names that two panoramas have, with both places.
  void assign(std::vector<PanoramaEntry>& panoramas, ManifestLog& log) const;

 private:
  struct Name {
    std::string text;  // a path with its extension, or a given name
    SourceLoc given_at;
    [[nodiscard]] bool is_given() const { return given_at.line > 0; }
  };

  std::vector<Name> names_;
};

}  // namespace shoal
