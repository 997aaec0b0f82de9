// A small library of panoramas with its manifest, for the tests of plans, runs and of verifying.
#pragma once

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <atomic>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <string>
#include <vector>

#include "batch/manifest_folder.h"
#include "batch/plan.h"
#include "batch/run.h"
#include "support/made_picture.h"

namespace shoal::test {

inline std::string content_of(const std::filesystem::path& path) {
  std::ifstream stream(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), {}};
}

class LibraryTest : public ManifestTest {
 protected:
  struct RunOptions {
    int threads = 2;
    PlanOptions plan;
    RunSettings::OnFailure on_failure = RunSettings::OnFailure::go_on;
  };

  // What a run said it would do, and what it did. Keys are the panoramas' names.
  struct Ran {
    std::map<std::string, std::string> reasons;
    std::map<std::string, ItemWork> work;
    RunSummary summary;
  };

  // A picture that is another one for every seed.
  void write_panorama(const std::string& name, std::uint64_t seed, int width = 24,
                      int height = 12) {
    const auto path = folder_ / name;
    std::filesystem::create_directories(path.parent_path());
    const auto format = path.extension() == ".exr" ? MapFormat::exr_float : MapFormat::hdr;
    write_picture(make_noisy_picture(width, height, seed), format, path);
  }

  // "a.hdr", "b.exr", "c.hdr" in lib/.
  void write_three() {
    write_panorama("lib/a.hdr", 1);
    write_panorama("lib/b.exr", 2, 40, 70);
    write_panorama("lib/c.hdr", 3);
  }

  // The manifest of all in lib/, with further keys.
  static std::string library(const std::string& more = "") {
    return "shoal: 1\noutput: out\npanoramas: [{files: \"lib/*.{hdr,exr}\"}]\n" + more;
  }

  Manifest manifest_of(const std::string& text) {
    ManifestResult result = load(text);
    EXPECT_TRUE(result.manifest) << result.messages;
    return result.manifest ? std::move(*result.manifest) : Manifest{};
  }

  Store open_store(const Manifest& manifest) {
    auto store = Store::open(manifest.output / kStoreFileName, Store::Access::write);
    EXPECT_TRUE(store) << store.error().text();
    return std::move(*store);
  }

  static void tell_plan(const Plan& plan, Ran& ran) {
    for (const PlannedItem& item : plan.items) {
      ran.reasons[item.entry->name] = item.reason;
      ran.work[item.entry->name] = item.work;
    }
  }

  Ran plan(const std::string& text, const PlanOptions& options = {}) {
    const Manifest manifest = manifest_of(text);
    Store store = open_store(manifest);
    const auto plan = make_plan(manifest, &store, options);
    Ran ran;
    EXPECT_TRUE(plan) << plan.error().text();
    if (plan) tell_plan(*plan, ran);
    return ran;
  }

  Ran run(const Manifest& manifest, const RunOptions& options, std::atomic<bool>& stop) {
    Store store = open_store(manifest);
    const auto plan = make_plan(manifest, &store, options.plan);
    Ran ran;
    EXPECT_TRUE(plan) << plan.error().text();
    if (!plan) return ran;
    tell_plan(*plan, ran);
    Progress progress(ProgressMode::none);
    RunSettings settings;
    settings.threads = options.threads;
    settings.on_failure = options.on_failure;
    auto summary = run_plan(manifest, *plan, store, settings, progress, stop);
    EXPECT_TRUE(summary) << summary.error().text();
    if (summary) ran.summary = std::move(*summary);
    return ran;
  }

  Ran run(const std::string& text, const RunOptions& options) {
    std::atomic<bool> stop{false};
    return run(manifest_of(text), options, stop);
  }
  Ran run(const std::string& text) { return run(text, RunOptions()); }

  // Every file below out/ but the store, by its path in there.
  std::map<std::string, std::string> outputs(const std::string& out = "out") {
    std::map<std::string, std::string> files;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(folder_ / out)) {
      const auto path = entry.path().lexically_relative(folder_ / out).string();
      if (entry.is_regular_file() && path != kStoreFileName) files[path] = content_of(entry.path());
    }
    return files;
  }

  std::string table(const std::string& name = "coefficients.csv") {
    return content_of(folder_ / ("out/" + name));
  }

  void remove_outputs() { std::filesystem::remove_all(folder_ / "out"); }

  // What a run from nothing writes.
  std::map<std::string, std::string> fresh_outputs(const std::string& text) {
    remove_outputs();
    run(text);
    return outputs();
  }
};

}  // namespace shoal::test
