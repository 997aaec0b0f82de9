#include "batch/run.h"

#include <algorithm>
#include <chrono>
#include <functional>
#include <mutex>
#include <utility>

#include "batch/fingerprint.h"
#include "batch/input_files.h"
#include "batch/item_outputs.h"
#include "batch/leftovers.h"
#include "batch/painted_light.h"
#include "batch/run_tables.h"
#include "batch/scheduler.h"
#include "batch/variant_facts.h"
#include "batch/variant_light.h"
#include "core/content_recorder.h"
#include "core/input_file.h"
#include "core/version.h"

namespace shoal {
namespace {

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point begin) {
  return std::chrono::duration<double>(Clock::now() - begin).count();
}

bool same_time(const InputState& a, const InputState& b) {
  return a.size == b.size && a.mtime_ns == b.mtime_ns;
}

// Whether the plan has the hash of the file as it is when it is opened.
bool knows_hash(const PlannedItem& item, const InputState& opened) {
  return item.input && same_time(*item.input, opened);
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
    opened_.resize(items_.size());
    notes_.resize(items_.size());
  }

  Status process();
  void report(RunSummary& summary) const;

 private:
  // An item's file when it was opened, and the hash of what was read of it where the plan does not
  // know that already.
  struct Opened {
    InputState state;
    std::shared_ptr<ContentRecorder> recorder;
  };

  // What is said of an item at the end.
  struct Notes {
    std::string failure;
    std::string layout;
    std::vector<std::string> warnings;
  };

  Result<std::unique_ptr<PanoramaProjection>> open(std::size_t index);
  void prefetch(std::size_t index, std::uint64_t limit);
  void finish(std::size_t index, PanoramaProjection* projection, Status status);
  Status complete(std::size_t index, PanoramaProjection* projection);
  Result<Projection> projection_of(const PlannedItem& item, PanoramaProjection* projection);
  void fail(std::size_t index, const Error& error);
  [[nodiscard]] ItemRecord record_of(const PlannedItem& item, ItemStatus status) const;
  Result<InputState> input_of(std::size_t index);
  void remember(const std::function<Status()>& write);

  const Manifest& manifest_;
  Store& store_;
  const RunSettings& settings_;
  Progress& progress_;
  std::atomic<bool>& stop_;
  std::vector<const PlannedItem*> items_;  // those that have something to do
  std::vector<Clock::time_point> began_;   // one an item; written and read by its workers in turn
  std::vector<Opened> opened_;             // likewise
  std::vector<Notes> notes_;
  ProjectionTables tables_;

  std::mutex mutex_;  // guards what follows, and the store
  Status store_status_;
  bool stopped_by_failure_ = false;
  std::int64_t done_count_ = 0;
  std::int64_t pixel_count_ = 0;
  std::uint64_t byte_count_ = 0;
  std::int64_t map_count_ = 0;
  std::int64_t export_count_ = 0;
};

Result<std::unique_ptr<PanoramaProjection>> Run::open(std::size_t index) {
  const PlannedItem& item = *items_[index];
  began_[index] = Clock::now();
  progress_.begin_panorama(item.entry->name);
  const EntrySettings& settings = *item.entry->settings;
  if (item.work == ItemWork::outputs || settings.origin == LightOrigin::lights) {
    return std::unique_ptr<PanoramaProjection>();
  }
  if (settings.origin == LightOrigin::sky) {
    return PanoramaProjection::open(painted_sky(item.entry->name, *settings.sky),
                                    settings.projection, tables_);
  }
  Opened& opened = opened_[index];
  if (auto state = entry_state(*item.entry)) opened.state = *state;
  ReadOptions read = item.entry->settings->read;
  if (!knows_hash(item, opened.state) && is_one_file(*item.entry)) {
    opened.recorder = read.recorder = std::make_shared<ContentRecorder>();
  }
  return PanoramaProjection::open(item.entry->file, read, item.entry->settings->projection,
                                  tables_);
}

// Asks for what open() will read soon.
void Run::prefetch(std::size_t index, std::uint64_t limit) {
  const PlannedItem& item = *items_[index];
  if (item.work == ItemWork::all && !item.entry->file.empty())
    prefetch_file(item.entry->file, limit);
}

Result<Projection> Run::projection_of(const PlannedItem& item, PanoramaProjection* projection) {
  if (projection != nullptr) return projection->finish();
  if (item.entry->settings->origin == LightOrigin::lights) {
    return lights_alone(*item.entry->settings);
  }
  const std::scoped_lock lock(mutex_);
  SHOAL_ASSIGN_OR_RETURN(stored, store_.find_projection(item.entry->name));
  if (stored) return std::move(*stored);
  return Error{ErrorCode::malformed, "its projection is missing from the store", item.entry->file,
               "run with --force"};
}

// The file's state with its hash: known from the plan, or taken as the file was read. The
// coefficients of one content must not be remembered as those of another, so the file must still be
// what was opened.
Result<InputState> Run::input_of(std::size_t index) {
  const PlannedItem& item = *items_[index];
  if (item.entry->file.empty()) return InputState{};
  if (item.work == ItemWork::outputs) return *item.input;
  auto [state, recorder] = std::move(opened_[index]);
  if (recorder) {
    SHOAL_ASSIGN_OR_RETURN(hash, recorder->digest(item.entry->file));
    state.content_hash = std::move(hash);
  } else if (knows_hash(item, state)) {
    state.content_hash = item.input->content_hash;
  } else {
    SHOAL_ASSIGN_OR_RETURN(
        hash, hash_panorama(item.entry->file, item.entry->settings->projection.layout));
    state.content_hash = std::move(hash);
  }
  SHOAL_ASSIGN_OR_RETURN(now, entry_state(*item.entry));
  if (same_time(now, state)) return std::move(state);
  return Error{ErrorCode::unreadable, "changed while it was read", item.entry->file, "run again"};
}

// The first error of the store ends the run. Called with mutex_ held.
void Run::remember(const std::function<Status()>& write) {
  if (!store_status_) return;
  store_status_ = write();
  if (!store_status_) stop_ = true;
}

// What the store is told of an item, whatever became of it.
ItemRecord Run::record_of(const PlannedItem& item, ItemStatus status) const {
  ItemRecord record;
  record.name = item.entry->name;
  record.engine_version = kVersion;
  record.state.status = status;
  record.state.input_path = stored_path(*item.entry);
  record.state.parameters = parameter_text(*item.entry->settings);
  record.state.output_hash = output_hash(manifest_, *item.entry);
  record.state.algorithm_version = kAlgorithmVersion;
  return record;
}

Status Run::complete(std::size_t index, PanoramaProjection* projection) {
  const PlannedItem& item = *items_[index];
  SHOAL_ASSIGN_OR_RETURN(result, projection_of(item, projection));
  SHOAL_ASSIGN_OR_RETURN(input, input_of(index));
  const Clock::time_point write_begin = Clock::now();
  SHOAL_ASSIGN_OR_RETURN(results, make_item_results(manifest_, *item.entry, result, stop_));

  ItemRecord done = record_of(item, ItemStatus::done);
  done.quality = std::move(results.quality);
  done.state.input_hash = input.content_hash;
  if (!item.entry->file.empty()) done.input = input;
  done.state.outputs = std::move(results.outputs);
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
                      "",
                      result.warnings};
  notes_[index].warnings = result.warnings;
  notes_[index].layout = result.recognised_layout;
  {
    const std::scoped_lock lock(mutex_);
    remember([&] { return store_.record(done); });
    ++done_count_;
    pixel_count_ += event.pixels;
    byte_count_ += event.bytes;
    for (const OutputRecord& output : done.state.outputs) {
      ++(output.kind.starts_with("export:") ? export_count_ : map_count_);
    }
  }
  progress_.end_panorama(event);
  return {};
}

void Run::fail(std::size_t index, const Error& error) {
  const PlannedItem& item = *items_[index];
  notes_[index].failure = error.text();
  ItemRecord failed = record_of(item, ItemStatus::failed);
  failed.state.error = error.text();
  {
    const std::scoped_lock lock(mutex_);
    remember([&] { return store_.record(failed); });
    if (settings_.on_failure == RunSettings::OnFailure::stop && !stop_.exchange(true)) {
      stopped_by_failure_ = true;
    }
  }
  progress_.end_panorama({item.entry->name,
                          PanoramaOutcome::failed,
                          seconds_since(began_[index]),
                          0,
                          item.input_size,
                          error.text(),
                          {}});
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
  steps.prefetch = [this](std::size_t index, std::uint64_t limit) { prefetch(index, limit); };
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
  summary.export_count = export_count_;
  summary.interrupted = stop_ && !stopped_by_failure_;
  for (std::size_t i = 0; i < items_.size(); ++i) {
    const std::string& name = items_[i]->entry->name;
    if (!notes_[i].failure.empty()) summary.failures.push_back({name, notes_[i].failure});
    if (!notes_[i].layout.empty()) summary.layouts.push_back({name, notes_[i].layout});
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
  const EntryOrigin* last = nullptr;
  for (const PanoramaEntry& entry : manifest.entries) {
    if (entry.origin->pattern.empty()) continue;
    if (entry.origin.get() != last) expansions.push_back({entry.origin->pattern, {}});
    expansions.back().files.push_back(stored_path(entry));
    last = entry.origin.get();
  }
  return expansions;
}

std::vector<PanoramaTags> tags_of(const Manifest& manifest) {
  std::vector<PanoramaTags> tags;
  for (const PanoramaEntry& entry : manifest.entries) {
    if (!entry.settings->tags.empty()) tags.push_back({entry.name, entry.settings->tags});
  }
  return tags;
}

// Files that were touched, but not changed: they need not be hashed again by the next run.
Status remember_inputs(const Plan& plan, Store& store) {
  for (const PlannedItem& item : plan.items) {
    if (item.work != ItemWork::none || !item.input_is_news) continue;
    SHOAL_RETURN_IF_ERROR(store.record_input(stored_path(*item.entry), *item.input));
  }
  return {};
}

std::vector<std::string> names_of(const Manifest& manifest) {
  std::vector<std::string> names;
  for (const PanoramaEntry& entry : manifest.entries) names.push_back(entry.name);
  return names;
}

// All but the mark that a run is under way.
Result<RunSummary> run_marked(const Manifest& manifest, const Plan& plan, Store& store,
                              const RunSettings& settings, Progress& progress,
                              std::atomic<bool>& stop) {
  SHOAL_RETURN_IF_ERROR(store.set_globs(expansions_of(manifest)));
  SHOAL_RETURN_IF_ERROR(store.set_tags(tags_of(manifest)));
  SHOAL_RETURN_IF_ERROR(remember_inputs(plan, store));
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
  if (stop) return summary;
  if (plan.unnamed_count > 0) SHOAL_RETURN_IF_ERROR(store.forget_others(names_of(manifest)));
  SHOAL_ASSIGN_OR_RETURN(variants, variant_facts(manifest));
  SHOAL_RETURN_IF_ERROR(store.set_variants(variants));
  SHOAL_ASSIGN_OR_RETURN(tables, write_run_tables(manifest, store));
  summary.tables = std::move(tables.paths);
  summary.missing_count = tables.missing_count;
  return summary;
}

}  // namespace

Result<RunSummary> run_plan(const Manifest& manifest, const Plan& plan, Store& store,
                            const RunSettings& settings, Progress& progress,
                            std::atomic<bool>& stop) {
  SHOAL_ASSIGN_OR_RETURN(mark, RunMark::set(manifest.output, store));
  auto summary = run_marked(manifest, plan, store, settings, progress, stop);
  Status cleared = mark.clear(store);
  if (summary && !cleared) return std::move(cleared).error();
  return summary;
}

}  // namespace shoal
