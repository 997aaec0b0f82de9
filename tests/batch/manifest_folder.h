// A folder with manifests and files that look like panoramas, for tests of reading manifests.
#pragma once

#include <gtest/gtest.h>

#include <fstream>
#include <string>
#include <vector>

#include "batch/manifest.h"
#include "support/temporary_folder.h"

namespace shoal::test {

class ManifestTest : public ::testing::Test {
 protected:
  void write(const std::string& name, const std::string& text) {
    std::filesystem::create_directories((folder_ / name).parent_path());
    std::ofstream(folder_ / name, std::ios::binary) << text;
  }

  // Empty files: reading a manifest opens no panorama.
  void touch(const std::vector<std::string>& names) {
    for (const std::string& name : names) write(name, "");
  }

  ManifestResult load(const std::string& text, const LoadOptions& options = {}) {
    write("m.yaml", text);
    return load_file("m.yaml", options);
  }

  ManifestResult load_file(const std::string& name, const LoadOptions& options = {}) {
    ManifestResult result = load_manifest(folder_ / name, options);
    result.messages = without_folder(result.messages);
    return result;
  }

  // What is told of a manifest, with its folder's path taken away.
  std::string messages(const std::string& text, const LoadOptions& options = {}) {
    return load(text, options).messages;
  }

  std::string without_folder(std::string text) const {
    const std::string prefix = folder_.path().string() + "/";
    for (auto at = text.find(prefix); at != std::string::npos; at = text.find(prefix)) {
      text.erase(at, prefix.size());
    }
    return text;
  }

  static std::vector<std::string> names(const ManifestResult& result) {
    std::vector<std::string> names;
    if (!result.manifest) return {"no manifest: " + result.messages};
    for (const PanoramaEntry& entry : result.manifest->entries) names.push_back(entry.name);
    return names;
  }

  TemporaryFolder folder_;
};

}  // namespace shoal::test
