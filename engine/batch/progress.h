// How far a run is, told while it goes on: to a person at a terminal, to a log, or to a program.
//
// bar    one line that is redrawn at most ten times a second and cleared at the end
// plain  a line now and then: none in the first two seconds, then at every tenth of the work, but
//        not twice within a second and at least every ten seconds; one at the end if there was one
// json   a line an event (JSON Lines), all with "event" and "elapsed" in seconds:
//          {"event": "start", "version": 1, "elapsed", "panoramas", "up_to_date", "bytes"}
//          {"event": "panorama", "elapsed", "name", "status": "done|failed|up to date", "seconds",
//           "pixels", "bytes", "finished", "panoramas"}        failed ones have "error" as well,
//                                              those with warnings "warnings", a list of sentences
//          {"event": "message", "elapsed", "text"}
//          {"event": "end", "elapsed", "done", "failed", "up_to_date", "pixels", "bytes"}
//        A reader must take keys and events that it does not know.
// none   messages only
//
// All calls may come from any thread at any time between start() and end().
#pragma once

#include <atomic>
#include <chrono>
#include <cstdint>
#include <functional>
#include <mutex>
#include <string>
#include <string_view>
#include <vector>

#include "core/result.h"
#include "core/terminal.h"

namespace shoal {

enum class ProgressMode { automatic, bar, plain, json, none };

// "auto", "bar", "plain", "json", "none". Error: usage.
[[nodiscard]] Result<ProgressMode> parse_progress_mode(std::string_view name);

// bar on an interactive terminal and plain elsewhere, for `automatic`; others stay.
[[nodiscard]] ProgressMode effective_mode(ProgressMode asked, const Terminal& terminal);

struct ProgressTotals {
  std::int64_t panoramas = 0;   // to be processed
  std::int64_t up_to_date = 0;  // that need not be
  std::uint64_t bytes = 0;      // of the files to be processed; 0: unknown
};

enum class PanoramaOutcome { done, failed, up_to_date };

struct PanoramaEvent {
  std::string name;
  PanoramaOutcome outcome = PanoramaOutcome::done;
  double seconds = 0.0;
  std::int64_t pixels = 0;
  std::uint64_t bytes = 0;  // of its file
  std::string error;        // of a failed one
  std::vector<std::string> warnings;
};

class Progress {
 public:
  using TimePoint = std::chrono::steady_clock::time_point;
  using Clock = std::function<TimePoint()>;
  using Sink = std::function<void(std::string_view)>;  // called by one thread at a time

  // To `sink`, which writes to what `terminal` describes.
  Progress(ProgressMode mode, Terminal terminal, Sink sink, Clock clock);

  // To standard error.
  explicit Progress(ProgressMode mode);

  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  void start(const ProgressTotals& totals);

  // A worker has begun with this panorama; its name is shown.
  void begin_panorama(std::string_view name);

  void end_panorama(const PanoramaEvent& event);

  // Grows as rows are projected, without a lock; for PanoramaProjection::work().
  [[nodiscard]] std::atomic<std::int64_t>& pixels_done() { return pixels_done_; }

  // Redraws where it is time to; nearly free otherwise. To be called a few times a second.
  void tick();

  // A line for a person, above the bar: a warning, an error. Without its line end.
  void message(std::string_view line);

  void end();

 private:
  struct Rates;

  [[nodiscard]] double elapsed() const;
  [[nodiscard]] Rates rates() const;
  [[nodiscard]] double fraction() const;
  [[nodiscard]] int tenths_done() const;
  [[nodiscard]] std::string bar_line() const;
  [[nodiscard]] std::string plain_line() const;
  void update();
  void draw_bar();
  void print_plain();
  void emit(std::string_view event, std::string_view fields);

  const ProgressMode mode_;
  const Terminal terminal_;
  const Sink sink_;
  const Clock clock_;

  std::atomic<std::int64_t> pixels_done_{0};
  std::atomic<std::int64_t> next_update_ns_{0};  // of the clock; before it tick() does nothing

  std::mutex mutex_;  // guards what follows
  TimePoint start_{};
  ProgressTotals totals_;
  std::int64_t done_ = 0;
  std::int64_t failed_ = 0;
  std::int64_t up_to_date_ = 0;
  std::uint64_t bytes_done_ = 0;
  std::string name_;  // of the panorama begun last, printable
  bool bar_shown_ = false;
  double plain_time_ = 0.0;  // seconds from the start to the last plain line
  int plain_tenths_ = -1;    // of the work that were done then; -1: there was no line yet
};

}  // namespace shoal
