#include "batch/run.h"

#include <algorithm>
#include <chrono>
#include <map>
#include <mutex>
#include <utility>

#include "batch/fingerprint.h"
#include "batch/item_outputs.h"
#include "batch/run_tables.h"
#include "batch/scheduler.h"
#include "core/content_hash.h"
#include "core/version.h"

namespace shoal {
namespace {

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point begin) {
  return std::chrono::duration<double>(Clock::now() - begin).count();
}

// The state of one run that its workers share.
class Run {
 public:
  Run(const Manifest& manifest, const Plan& plan, Store& store, const RunSettings& settings,
      Progress& progress, std::atomic<bool>& stop)
      : manifest_(manifest), store_(store), settings_(settings), progress_(progress), stop_(stop) {
    for (const PlannedItem& item : plan.items) {
      if (item.work != ItemWork::none) items_.push_back(&item);
    }
    began_.resize(items_.size());
    notes_.resize(items_.size());
  }

  Status process();
  void report(RunSummary& summary) const;

 private:
  // What is said of an item at the end.
  struct Notes {
    std::string failure;
    std::vector<std::string> warnings;
  };

  Result<std::unique_ptr<PanoramaProjection>> open(std::size_t index);
  void finish(std::size_t index, PanoramaProjection* projection, Status status);
  Status complete(std::size_t index, PanoramaProjection* projection);
  Result<Projection> projection_of(const PlannedItem& item, PanoramaProjection* projection);
  void fail(std::size_t index, const Error& error);
  Status record(const PlannedItem& item, ItemRecord record);
  Result<InputState> input_of(const PlannedItem& item);

  const Manifest& manifest_;
  Store& store_;
  const RunSettings& settings_;
  Progress& progress_;
  std::atomic<bool>& stop_;
  std::vector<const PlannedItem*> items_;  // those that have something to do
  std::vector<Clock::time_point> began_;   // one an item; written and read by its workers in turn
  std::vector<Notes> notes_;
  ProjectionTables tables_;

  std::mutex mutex_;  // guards what follows, and the store
  Status store_status_;
  std::int64_t done_count_ = 0;
  std::int64_t pixel_count_ = 0;
  std::uint64_t byte_count_ = 0;
  std::int64_t map_count_ = 0;
};

Result<std::unique_ptr<PanoramaProjection>> Run::open(std::size_t index) {
  const PlannedItem& item = *items_[index];
  began_[index] = Clock::now();
  progress_.begin_panorama(item.entry->name);
  if (item.work == ItemWork::outputs) return std::unique_ptr<PanoramaProjection>();
  return PanoramaProjection::open(item.entry->file, item.entry->read, item.entry->projection,
                                  tables_);
}

Result<Projection> Run::projection_of(const PlannedItem& item, PanoramaProjection* projection) {
  if (projection != nullptr) return projection->finish();
  const std::scoped_lock lock(mutex_);
  SHOAL_ASSIGN_OR_RETURN(stored, store_.find_projection(item.entry->name));
  if (stored) return std::move(*stored);
  return Error{ErrorCode::malformed, "its projection is missing from the store",
               item.entry->file.string(), "run with --force"};
}

// The file's state with its hash: known from the plan, or taken now. A file that changes while it
// is read would be remembered wrongly, so its size and time must still be those from before.
Result<InputState> Run::input_of(const PlannedItem& item) {
  if (item.input) return *item.input;
  SHOAL_ASSIGN_OR_RETURN(state, input_state(item.entry->file));
  SHOAL_ASSIGN_OR_RETURN(hash, hash_file(item.entry->file));
  state.content_hash = hash;
  return state;
}

Status Run::record(const PlannedItem& item, ItemRecord record) {
  record.name = item.entry->name;
  record.engine_version = kVersion;
  record.state.input_path = item.entry->file.string();
  record.state.parameters = item.parameters;
  record.state.output_hash = item.output_hash;
  record.state.algorithm_version = kAlgorithmVersion;
  return store_.record(record);
}

Status Run::complete(std::size_t index, PanoramaProjection* projection) {
  const PlannedItem& item = *items_[index];
  SHOAL_ASSIGN_OR_RETURN(result, projection_of(item, projection));
  SHOAL_ASSIGN_OR_RETURN(input, input_of(item));
  const Clock::time_point write_begin = Clock::now();
  SHOAL_ASSIGN_OR_RETURN(outputs, write_item_maps(manifest_, *item.entry, result));

  ItemRecord done;
  done.state.status = ItemStatus::done;
  done.state.input_hash = input.content_hash;
  done.state.outputs = outputs;
  done.projection = &result;
  done.timings.write_seconds = seconds_since(write_begin);
  if (projection != nullptr) {
    done.timings.decode_seconds = projection->seconds().reading;
    done.timings.project_seconds = projection->seconds().projecting;
  }
  const bool projected = projection != nullptr;
  PanoramaEvent event{item.entry->name,
                      PanoramaOutcome::done,
                      seconds_since(began_[index]),
                      projected ? result.pixels.pixel_count : 0,
                      projected ? input.size : 0,
                      ""};
  notes_[index].warnings = std::move(result.warnings);
  {
    const std::scoped_lock lock(mutex_);
    store_status_ = store_.record_input(item.entry->file.string(), input);
    if (store_status_) store_status_ = record(item, std::move(done));
    if (!store_status_) stop_ = true;
    ++done_count_;
    pixel_count_ += event.pixels;
    byte_count_ += event.bytes;
    map_count_ += static_cast<std::int64_t>(outputs.size());
  }
  progress_.end_panorama(event);
  return {};
}

void Run::fail(std::size_t index, const Error& error) {
  const PlannedItem& item = *items_[index];
  notes_[index].failure = error.text();
  ItemRecord failed;
  failed.state.status = ItemStatus::failed;
  failed.state.error = error.text();
  {
    const std::scoped_lock lock(mutex_);
    store_status_ = record(item, std::move(failed));
    if (!store_status_ || settings_.on_failure == RunSettings::OnFailure::stop) stop_ = true;
  }
  progress_.end_panorama({item.entry->name, PanoramaOutcome::failed, seconds_since(began_[index]),
                          0, item.input_size, error.text()});
}

void Run::finish(std::size_t index, PanoramaProjection* projection, Status status) {
  if (status) status = complete(index, projection);
  // What was interrupted did not fail: it stays as it was, to be done by the next run.
  if (!status && status.error().code != ErrorCode::interrupted) fail(index, status.error());
}

Status Run::process() {
  std::vector<std::string> names;
  for (const PlannedItem* item : items_) names.push_back(item->entry->name);
  SHOAL_RETURN_IF_ERROR(store_.mark_stale(names));
  JobSteps steps;
  steps.open = [this](std::size_t index) { return open(index); };
  steps.finish = [this](std::size_t index, PanoramaProjection* projection, Status status) {
    finish(index, projection, std::move(status));
  };
  steps.tick = [this] { progress_.tick(); };
  run_jobs(items_.size(), settings_.threads, stop_, progress_.pixels_done(), steps);
  SHOAL_RETURN_IF_ERROR(store_status_);
  return store_.flush();
}

void Run::report(RunSummary& summary) const {
  summary.done_count = done_count_;
  summary.pixel_count = pixel_count_;
  summary.byte_count = byte_count_;
  summary.map_count = map_count_;
  for (std::size_t i = 0; i < items_.size(); ++i) {
    const std::string& name = items_[i]->entry->name;
    if (!notes_[i].failure.empty()) summary.failures.push_back({name, notes_[i].failure});
    for (const std::string& warning : notes_[i].warnings)
      summary.warnings.push_back({name, warning});
  }
}

ProgressTotals totals_of(const Plan& plan) {
  ProgressTotals totals;
  for (const PlannedItem& item : plan.items) {
    if (item.work == ItemWork::none) {
      ++totals.up_to_date;
    } else {
      ++totals.panoramas;
      if (item.work == ItemWork::all) totals.bytes += item.input_size;
    }
  }
  return totals;
}

// The manifest's globs as they were expanded. The entries of one glob follow one another.
std::vector<GlobExpansion> expansions_of(const Manifest& manifest) {
  std::vector<GlobExpansion> expansions;
  const SourceLoc* last = nullptr;
  for (const PanoramaEntry& entry : manifest.entries) {
    if (entry.pattern.empty()) continue;
    const bool same = last != nullptr && last->line == entry.loc.line &&
                      last->column == entry.loc.column && last->file == entry.loc.file;
    if (!same) expansions.push_back({entry.pattern, {}});
    expansions.back().files.push_back(entry.file.string());
    last = &entry.loc;
  }
  return expansions;
}

}  // namespace

Result<RunSummary> run_plan(const Manifest& manifest, const Plan& plan, Store& store,
                            const RunSettings& settings, Progress& progress,
                            std::atomic<bool>& stop) {
  SHOAL_RETURN_IF_ERROR(store.set_globs(expansions_of(manifest)));
  RunSummary summary;
  summary.up_to_date_count = plan.count(ItemWork::none);
  const Clock::time_point begin = Clock::now();
  progress.start(totals_of(plan));
  Run run(manifest, plan, store, settings, progress, stop);
  const Status processed = run.process();
  progress.end();
  SHOAL_RETURN_IF_ERROR(processed);
  summary.seconds = seconds_since(begin);
  run.report(summary);
  summary.interrupted = stop && summary.failures.empty();
  if (stop) return summary;
  SHOAL_ASSIGN_OR_RETURN(tables, write_run_tables(manifest, store));
  summary.tables = std::move(tables.paths);
  summary.missing_count = tables.missing_count;
  return summary;
}

}  // namespace shoal
