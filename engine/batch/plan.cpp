#include "batch/plan.h"

#include <sys/stat.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <unordered_map>

#include "batch/fingerprint.h"
#include "batch/glob.h"
#include "core/content_hash.h"

namespace shoal {
namespace {

using Items = std::unordered_map<std::string, ItemState>;
using Inputs = std::unordered_map<std::string, InputState>;

// The store's memory of what is planned.
struct Known {
  Items items;
  Inputs inputs;
};

Result<Known> read_known(Store* store) {
  Known known;
  if (store == nullptr) return known;
  SHOAL_ASSIGN_OR_RETURN(items, store->items());
  SHOAL_ASSIGN_OR_RETURN(inputs, store->inputs());
  known.items = std::move(items);
  known.inputs = std::move(inputs);
  return known;
}

// Gives the item its file's state with the hash: the store's where size and time allow, else from
// the content. Without one, the run will say what is wrong with the file.
void find_input(const Known& known, const PlanOptions& options, InputState state,
                PlannedItem& item) {
  const auto found = known.inputs.find(stored_path(*item.entry));
  const bool same_time = found != known.inputs.end() && found->second.size == state.size &&
                         found->second.mtime_ns == state.mtime_ns;
  if (same_time && options.inputs == PlanOptions::Inputs::by_time) {
    item.input = found->second;
    return;
  }
  auto hash = hash_file(item.entry->file);
  if (!hash) return;
  state.content_hash = std::move(*hash);
  item.input_is_news = found == known.inputs.end() || found->second != state;
  item.input = std::move(state);
}

// Decides about one item; `item` comes with its hashes.
void decide(const Manifest& manifest, const Known& known, const PlanOptions& options,
            PlannedItem& item) {
  const auto needs = [&](ItemWork work, std::string_view reason) {
    item.work = work;
    item.reason = reason;
  };
  auto state = input_state(item.entry->file);
  if (state) item.input_size = state->size;
  const auto found = known.items.find(item.entry->name);
  if (found == known.items.end()) return needs(ItemWork::all, "new");
  const ItemState& before = found->second;
  if (options.force == PlanOptions::Force::yes) return needs(ItemWork::all, "forced");
  if (before.status == ItemStatus::failed) return needs(ItemWork::all, "failed before");
  if (before.status == ItemStatus::stale) return needs(ItemWork::all, "was interrupted");
  if (!state) return needs(ItemWork::all, "its file cannot be read");
  if (before.algorithm_version != kAlgorithmVersion) {
    return needs(ItemWork::all, "shoal computes differently now");
  }
  if (before.parameters != item.parameters) {
    return needs(ItemWork::all, "its parameters changed");
  }
  find_input(known, options, *state, item);
  if (!item.input) return needs(ItemWork::all, "its file cannot be read");
  if (item.input->content_hash != before.input_hash) {
    return needs(ItemWork::all, "its file's content changed");
  }
  if (before.output_hash != item.output_hash) {
    return needs(ItemWork::outputs, "its maps are asked for differently");
  }
  if (!outputs_stand(manifest.output, before.outputs)) {
    return needs(ItemWork::outputs, "a file that it wrote is missing or has another size");
  }
  needs(ItemWork::none, "up to date");
}

Result<std::optional<Glob>> parse_only(const std::string& only) {
  if (only.empty()) return std::optional<Glob>();
  SHOAL_ASSIGN_OR_RETURN(glob, Glob::parse(only));
  return std::optional<Glob>(std::move(glob));
}

bool is_selected(const std::optional<Glob>& only, const PanoramaEntry& entry) {
  return !only || only->selects(entry.name) ||
         std::ranges::any_of(entry.tags,
                             [&](const std::string& tag) { return only->matches(tag); });
}

}  // namespace

std::int64_t Plan::count(ItemWork work) const {
  return std::ranges::count_if(items, [&](const auto& item) { return item.work == work; });
}

std::string stored_path(const PanoramaEntry& entry) {
  std::error_code code;
  const auto path = std::filesystem::absolute(entry.file, code);
  return (code ? entry.file : path).lexically_normal().string();
}

bool outputs_stand(const std::filesystem::path& folder, std::span<const OutputRecord> outputs) {
  return std::ranges::all_of(outputs, [&](const OutputRecord& output) {
    struct stat info {};
    return ::stat((folder / output.path).c_str(), &info) == 0 &&
           static_cast<std::uint64_t>(info.st_size) == output.size;
  });
}

Result<InputState> input_state(const std::filesystem::path& path) {
  struct stat info {};
  if (::stat(path.c_str(), &info) != 0) {
    const auto code = errno == ENOENT ? ErrorCode::not_found : ErrorCode::unreadable;
    return Error{code, std::strerror(errno), path.string(), ""};
  }
  InputState state;
  state.size = static_cast<std::uint64_t>(info.st_size);
  state.mtime_ns = std::int64_t{info.st_mtim.tv_sec} * 1'000'000'000 + info.st_mtim.tv_nsec;
  return state;
}

Result<Plan> make_plan(const Manifest& manifest, Store* store, const PlanOptions& options) {
  SHOAL_ASSIGN_OR_RETURN(only, parse_only(options.only));
  SHOAL_ASSIGN_OR_RETURN(known, read_known(store));
  Plan plan;
  std::size_t named = 0;
  for (const PanoramaEntry& entry : manifest.entries) {
    if (known.items.contains(entry.name)) ++named;
    if (!is_selected(only, entry)) {
      ++plan.unselected_count;
      continue;
    }
    PlannedItem item;
    item.entry = &entry;
    item.parameters = parameter_text(entry);
    item.output_hash = output_hash(manifest, entry);
    decide(manifest, known, options, item);
    plan.items.push_back(std::move(item));
  }
  plan.unnamed_count = static_cast<std::int64_t>(known.items.size() - named);
  if (plan.items.empty()) {
    return Error{ErrorCode::usage, "no panorama has a name or tag like \"" + options.only + "\"",
                 manifest.path.string(), "shoal check lists the names"};
  }
  return plan;
}

}  // namespace shoal
