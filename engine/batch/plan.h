// What a run will do, and why: the manifest held against the store. Nothing is written here.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "batch/manifest.h"
#include "batch/store.h"
#include "core/result.h"

namespace shoal {

// How much of an item has to be done.
enum class ItemWork {
  none,     // up to date
  outputs,  // its projection holds; its maps and exports have to be written anew
  all,
};

struct PlannedItem {
  const PanoramaEntry* entry = nullptr;
  ItemWork work = ItemWork::all;
  std::string_view reason;          // for people: "new", "its file's content changed", "up to date"
  std::uint64_t input_size = 0;     // bytes; 0 where the file cannot be asked
  std::optional<InputState> input;  // of the file as it is now, where its content's hash is known;
                                    // empty for an entry without a file
  bool input_is_news = false;       // the store does not know `input` yet
};

struct PlanOptions {
  enum class Inputs {
    by_time,     // unchanged size and modification time stand for unchanged content
    by_content,  // every file is hashed
  };
  enum class Force { no, yes };
  Inputs inputs = Inputs::by_time;
  Force force = Force::no;
  std::string only;  // a glob over names and tags; empty: all
};

struct Plan {
  std::vector<PlannedItem> items;  // the selected entries in manifest order
  std::int64_t unselected_count = 0;
  std::int64_t unnamed_count = 0;  // panoramas that the store knows and the manifest does not name

  [[nodiscard]] std::int64_t count(ItemWork work) const;
};

// `store`: of an earlier run, or null. Errors: usage (a bad `only`, or one that selects nothing);
// malformed, unreadable (the store).
Result<Plan> make_plan(const Manifest& manifest, Store* store, const PlanOptions& options);

// Where the entry of a name is among the manifest's. Lives no longer than the manifest.
using EntryIndex = std::unordered_map<std::string_view, std::size_t>;
[[nodiscard]] EntryIndex index_entries(const Manifest& manifest);

// The entry's file as the store knows it: absolute, so that a run from another folder finds it;
// empty where it has none.
[[nodiscard]] std::string stored_path(const PanoramaEntry& entry);

// Whether all of these files are there with the sizes that they were written with.
[[nodiscard]] bool outputs_stand(const std::filesystem::path& folder,
                                 std::span<const OutputRecord> outputs);

// Size and modification time of a file, without its hash. Error: not_found, unreadable.
Result<InputState> input_state(const std::filesystem::path& path);

}  // namespace shoal
