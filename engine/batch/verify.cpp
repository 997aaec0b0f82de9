#include "batch/verify.h"

#include <algorithm>
#include <map>
#include <mutex>

#include "batch/fingerprint.h"
#include "batch/input_files.h"
#include "batch/painted_light.h"
#include "batch/scheduler.h"
#include "batch/store.h"
#include "core/content_hash.h"
#include "transform/projector.h"

namespace shoal {
namespace {

using NamedItem = std::pair<std::string, ItemState>;

std::string problem(const std::string& path, const std::string& what) { return path + ": " + what; }

void check_output(const std::filesystem::path& folder, const OutputRecord& output,
                  VerifyReport& report) {
  ++report.output_count;
  const auto path = folder / output.path;
  const auto hash = hash_file(path);
  if (!hash) {
    report.problems.push_back(hash.error().text());
  } else if (*hash != output.content_hash) {
    report.problems.push_back(problem(path.string(), "is not what the run wrote"));
  }
}

void check_item(const std::filesystem::path& folder, const NamedItem& item, VerifyReport& report) {
  const auto& [name, state] = item;
  ++report.panorama_count;
  if (state.status == ItemStatus::failed) {
    report.problems.push_back(problem(name, "failed: " + state.error));
    return;
  }
  if (state.status == ItemStatus::stale) {
    report.problems.push_back(problem(name, "was interrupted; run again"));
    return;
  }
  for (const OutputRecord& output : state.outputs) check_output(folder, output, report);
  if (state.input_path.empty()) return;
  const auto parameters = parse_parameters(state.parameters);
  const auto hash = hash_panorama(state.input_path,
                                  parameters ? parameters->projection.layout : Layout::equirect);
  if (!hash) {
    report.problems.push_back(hash.error().text());
  } else if (*hash != state.input_hash) {
    report.problems.push_back(problem(state.input_path, "has changed since it was projected"));
  }
}

// Of a file, or of a sky.
bool has_pixels(const ItemState& state) {
  if (!state.input_path.empty()) return true;
  const auto parameters = parse_parameters(state.parameters);
  return parameters && parameters->sky;
}

// Projects all items anew and compares bit by bit.
void recompute(Store& store, const std::vector<NamedItem>& items, const VerifyOptions& options,
               const std::atomic<bool>& stop, VerifyReport& report) {
  ProjectionTables tables;
  std::mutex mutex;                             // guards the store and the report
  std::map<std::size_t, std::string> problems;  // by item, so that their order is the items'
  const auto compare = [&](const std::string& name, const Projection& now) -> std::string {
    const std::scoped_lock lock(mutex);
    auto before = store.find_projection(name);
    if (!before) return before.error().text();
    if (!*before) return problem(name, "its projection is missing from the store");
    ++report.recomputed_count;
    const bool same = (*before)->radiance == now.radiance && (*before)->finer == now.finer;
    return same ? "" : problem(name, "projects to other coefficients");
  };
  JobSteps steps;
  steps.open = [&](std::size_t index) -> Result<std::unique_ptr<PanoramaProjection>> {
    const ItemState& state = items[index].second;
    SHOAL_ASSIGN_OR_RETURN(parameters, parse_parameters(state.parameters));
    if (parameters.sky) {
      return PanoramaProjection::open(painted_sky(items[index].first, *parameters.sky),
                                      parameters.projection, tables);
    }
    return PanoramaProjection::open(state.input_path, parameters.read, parameters.projection,
                                    tables);
  };
  steps.finish = [&](std::size_t index, PanoramaProjection* projection, Status status) {
    std::string text;
    Result<Projection> now =
        status ? projection->finish() : Result<Projection>(std::move(status).error());
    text = now ? compare(items[index].first, *now) : now.error().text();
    const std::scoped_lock lock(mutex);
    if (!text.empty()) problems[index] = text;
  };
  std::atomic<std::int64_t> pixels_done{0};
  run_jobs(items.size(), options.threads, stop, pixels_done, steps);
  for (auto& [index, text] : problems) report.problems.push_back(std::move(text));
}

}  // namespace

Result<VerifyReport> verify_outputs(const std::filesystem::path& folder,
                                    const VerifyOptions& options, const std::atomic<bool>& stop) {
  SHOAL_ASSIGN_OR_RETURN(store, Store::open(folder / kStoreFileName, Store::Access::read));
  SHOAL_ASSIGN_OR_RETURN(known, store.items());
  std::vector<NamedItem> items(known.begin(), known.end());
  std::ranges::sort(items, {}, &NamedItem::first);
  VerifyReport report;
  for (const NamedItem& item : items) {
    if (stop) return Error{ErrorCode::interrupted, "interrupted", "", ""};
    check_item(folder, item, report);
  }
  SHOAL_ASSIGN_OR_RETURN(tables, store.run_outputs());
  for (const OutputRecord& table : tables) check_output(folder, table, report);
  if (options.recompute == VerifyOptions::Recompute::yes) {
    // Lights in closed form have no pixels to be projected anew.
    std::erase_if(items, [](const NamedItem& item) {
      return item.second.status != ItemStatus::done || !has_pixels(item.second);
    });
    recompute(store, items, options, stop, report);
    if (stop) return Error{ErrorCode::interrupted, "interrupted", "", ""};
  }
  return report;
}

}  // namespace shoal
