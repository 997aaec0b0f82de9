#include "batch/plan.h"

#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <climits>
#include <cstring>
#include <utility>

#include "batch/fingerprint.h"
#include "batch/glob.h"
#include "batch/input_files.h"

namespace shoal {
namespace {

// What the store knows of an entry, held against what the entry is now: small, since there is one
// for each of a hundred thousand.
struct Before {
  bool is_known = false;
  ItemStatus status = ItemStatus::done;
  bool same_algorithm = false;
  bool same_parameters = false;
  bool same_outputs = false;        // asked for
  std::string input_hash;           // of the content that was processed
  std::optional<InputState> input;  // of the entry's file, when last hashed
  std::vector<OutputRecord> outputs;
};

struct Known {
  std::vector<Before> entries;  // in the manifest's order
  std::int64_t unnamed_count = 0;
};

void compare(const Manifest& manifest, const PanoramaEntry& entry, const ItemRow& row,
             SettingsText& parameters, Before& before) {
  before.is_known = true;
  before.status = row.status;
  before.same_algorithm = row.algorithm_version == kAlgorithmVersion;
  before.same_parameters = row.parameters == parameters.of(entry);
  before.same_outputs = row.output_hash == output_hash(manifest, entry);
  before.input_hash = row.input_hash;
  if (row.input && row.input_path == stored_path(entry)) {
    before.input = {row.input->size, row.input->mtime_ns, std::string(row.input->content_hash)};
  }
}

Result<Known> read_known(const Manifest& manifest, Store* store) {
  Known known;
  known.entries.resize(manifest.entries.size());
  if (store == nullptr) return known;
  const EntryIndex index_by_name = index_entries(manifest);
  SettingsText parameters(parameter_text);
  std::unordered_map<std::int64_t, std::size_t> index_by_id;
  SHOAL_RETURN_IF_ERROR(store->for_each_item([&](const ItemRow& row) {
    const auto found = index_by_name.find(row.name);
    if (found == index_by_name.end()) {
      ++known.unnamed_count;
      return;
    }
    const std::size_t index = found->second;
    compare(manifest, manifest.entries[index], row, parameters, known.entries[index]);
    if (!manifest.maps.empty() || !manifest.exports.empty() ||
        manifest.entries[index].settings->picture) {
      index_by_id.emplace(row.id, index);
    }
  }));
  SHOAL_RETURN_IF_ERROR(store->for_each_output([&](std::int64_t id, OutputRecord output) {
    const auto found = index_by_id.find(id);
    if (found != index_by_id.end()) {
      known.entries[found->second].outputs.push_back(std::move(output));
    }
  }));
  return known;
}

// Gives the item its file's state with the hash: the store's where size and time allow, else from
// the content. Without one, the run will say what is wrong with the file.
Status find_input(const Before& before, Store& store, const PlanOptions& options, InputState state,
                  PlannedItem& item) {
  std::optional<InputState> known = before.input;
  // The panorama may have been projected from another file of the same name.
  if (!known) {
    SHOAL_ASSIGN_OR_RETURN(elsewhere, store.find_input(stored_path(*item.entry)));
    known = std::move(elsewhere);
  }
  const bool same_time = known && known->size == state.size && known->mtime_ns == state.mtime_ns;
  if (same_time && options.inputs == PlanOptions::Inputs::by_time) {
    item.input = std::move(known);
    return {};
  }
  auto hash = hash_panorama(item.entry->file, item.entry->settings->projection.layout);
  if (!hash) return {};
  state.content_hash = std::move(*hash);
  item.input_is_news = known != state;
  item.input = std::move(state);
  return {};
}

// What has to be done with an item, and why.
Status decide(const Manifest& manifest, const Before& before, Store* store,
              const PlanOptions& options, PlannedItem& item) {
  const auto needs = [&](ItemWork work, std::string_view reason) -> Status {
    item.work = work;
    item.reason = reason;
    return {};
  };
  const bool has_file = !item.entry->file.empty();
  auto state = has_file ? entry_state(*item.entry) : InputState{};
  if (state) item.input_size = state->size;
  if (!before.is_known) return needs(ItemWork::all, "new");
  if (options.force == PlanOptions::Force::yes) return needs(ItemWork::all, "forced");
  if (before.status == ItemStatus::failed) return needs(ItemWork::all, "failed before");
  if (before.status == ItemStatus::stale) return needs(ItemWork::all, "was interrupted");
  if (!state) return needs(ItemWork::all, "its file cannot be read");
  if (!before.same_algorithm) return needs(ItemWork::all, "shoal computes differently now");
  if (!before.same_parameters) return needs(ItemWork::all, "its parameters changed");
  if (has_file) {
    SHOAL_RETURN_IF_ERROR(find_input(before, *store, options, *state, item));
  } else {
    item.input = InputState{};
  }
  if (!item.input) return needs(ItemWork::all, "its file cannot be read");
  if (item.input->content_hash != before.input_hash) {
    return needs(ItemWork::all, "its file's content changed");
  }
  if (!before.same_outputs)
    return needs(ItemWork::outputs, "its outputs are asked for differently");
  if (!outputs_stand(manifest.output, before.outputs)) {
    return needs(ItemWork::outputs, "a file that it wrote is missing or has another size");
  }
  return needs(ItemWork::none, "up to date");
}

// Whether the path has no parts that say nothing, nor any that lead back.
bool is_normal(std::string_view path) {
  if (path.starts_with('/')) path.remove_prefix(1);
  for (;;) {
    const std::size_t slash = std::min(path.find('/'), path.size());
    const std::string_view part = path.substr(0, slash);
    if (part.empty() || part == "." || part == "..") return false;
    if (slash == path.size()) return true;
    path.remove_prefix(slash + 1);
  }
}

Result<std::optional<Glob>> parse_only(const std::string& only) {
  if (only.empty()) return std::optional<Glob>();
  SHOAL_ASSIGN_OR_RETURN(glob, Glob::parse(only));
  return std::optional<Glob>(std::move(glob));
}

bool is_selected(const std::optional<Glob>& only, const PanoramaEntry& entry) {
  return !only || only->selects(entry.name) ||
         std::ranges::any_of(entry.settings->tags,
                             [&](const std::string& tag) { return only->matches(tag); });
}

}  // namespace

std::int64_t Plan::count(ItemWork work) const {
  return std::ranges::count_if(items, [&](const auto& item) { return item.work == work; });
}

EntryIndex index_entries(const Manifest& manifest) {
  EntryIndex index(manifest.entries.size());
  for (std::size_t i = 0; i < manifest.entries.size(); ++i) {
    index.emplace(manifest.entries[i].name, i);
  }
  return index;
}

std::string stored_path(const PanoramaEntry& entry) {
  if (entry.file.empty()) return "";
  // A file that a glob found is spelt normally already; std::filesystem takes 5 us to see that, and
  // a run over a large library asks three times a file.
  if (is_normal(entry.file)) {
    if (entry.file.front() == '/') return entry.file;
    char folder[PATH_MAX];
    if (::getcwd(folder, sizeof folder) != nullptr && folder[1] != '\0') {
      return std::string(folder) + '/' + entry.file;
    }
  }
  std::error_code code;
  const auto path = std::filesystem::absolute(entry.file, code);
  return (code ? std::filesystem::path(entry.file) : path).lexically_normal().string();
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
  SHOAL_ASSIGN_OR_RETURN(known, read_known(manifest, store));
  Plan plan;
  plan.unnamed_count = known.unnamed_count;
  for (std::size_t i = 0; i < manifest.entries.size(); ++i) {
    const PanoramaEntry& entry = manifest.entries[i];
    if (!is_selected(only, entry)) {
      ++plan.unselected_count;
      continue;
    }
    PlannedItem item;
    item.entry = &entry;
    SHOAL_RETURN_IF_ERROR(decide(manifest, known.entries[i], store, options, item));
    plan.items.push_back(std::move(item));
  }
  if (plan.items.empty()) {
    return Error{ErrorCode::usage, "no panorama has a name or tag like \"" + options.only + "\"",
                 manifest.path.string(), "shoal check lists the names"};
  }
  return plan;
}

}  // namespace shoal
