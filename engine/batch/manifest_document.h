// One manifest file, read and parsed as YAML. What its keys mean is not known here.
#pragma once

#include <yaml-cpp/node/node.h>

#include <filesystem>
#include <memory>
#include <string>

#include "batch/manifest_log.h"

namespace shoal {

struct ManifestDocument {
  std::string path;  // as diagnostics show it
  std::filesystem::path
      folder;       // what the paths in it are relative to; "" is the working directory
  YAML::Node root;  // a mapping

  [[nodiscard]] SourceLoc loc(const YAML::Node& node) const;
};

// Reads `path`. A document that cannot be used is null, with one error in the log: what the system
// says, not UTF-8 text, not YAML, more than one document, no mapping. Errors of the system are told
// at `named_at`, the place that names the file, or at the file itself where that is empty.
[[nodiscard]] std::shared_ptr<const ManifestDocument> load_document(
    const std::filesystem::path& path, const SourceLoc& named_at, ManifestLog& log);

// The same of a text; `path` is for messages and for the folder.
[[nodiscard]] std::shared_ptr<const ManifestDocument> parse_document(
    const std::filesystem::path& path, std::string text, ManifestLog& log);

}  // namespace shoal
