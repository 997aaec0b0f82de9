#include "batch/progress.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "core/diagnostic.h"
#include "output/text_quoting.h"

namespace shoal {
namespace {

constexpr auto kUpdateInterval = std::chrono::milliseconds(100);
constexpr double kQuietSeconds = 2.0;       // runs shorter than this print no plain line
constexpr double kPlainSeconds = 10.0;      // at least a line each,
constexpr double kPlainShortSeconds = 1.0;  // at most a line each
constexpr int kBarCells = 20;
constexpr int kColumnsForBar = 70;  // narrower terminals get no cells
constexpr const char* kClearLine = "\r\x1b[K";

constexpr std::array<std::string_view, 5> kModes = {"auto", "bar", "plain", "json", "none"};

void write_to_stderr(std::string_view text) {
  while (!text.empty()) {
    const ssize_t written = ::write(STDERR_FILENO, text.data(), text.size());
    if (written <= 0) return;  // nobody reads the messages; the run goes on
    text.remove_prefix(static_cast<std::size_t>(written));
  }
}

std::int64_t nanoseconds(Progress::TimePoint time) {
  return std::chrono::duration_cast<std::chrono::nanoseconds>(time.time_since_epoch()).count();
}

// 0:07, 12:34, 3:25:45.
std::string duration_text(double seconds) {
  const auto whole = std::llround(std::min(seconds, 3.6e8));
  const std::int64_t hours = whole / 3600;
  const std::int64_t minutes = whole / 60 % 60;
  if (hours == 0) return fmt::format("{}:{:02}", minutes, whole % 60);
  return fmt::format("{}:{:02}:{:02}", hours, minutes, whole % 60);
}

std::string_view name_of(PanoramaOutcome outcome) {
  switch (outcome) {
    case PanoramaOutcome::done:
      return "done";
    case PanoramaOutcome::failed:
      return "failed";
    case PanoramaOutcome::up_to_date:
      return "up to date";
  }
  return "";
}

std::string json_list(const std::vector<std::string>& texts) {
  std::string list;
  for (const std::string& text : texts) list += (list.empty() ? "[" : ", ") + json_quoted(text);
  return list + "]";
}

}  // namespace

// Throughput and time left. The mean over the whole run: steadier than a recent one, and what the
// summary says.
struct Progress::Rates {
  double megapixels = 0.0;  // a second
  double megabytes = 0.0;   // a second
  double remaining = -1.0;  // seconds; negative: unknown
};

Result<ProgressMode> parse_progress_mode(std::string_view name) {
  const auto found = std::find(kModes.begin(), kModes.end(), name);
  if (found != kModes.end()) return static_cast<ProgressMode>(found - kModes.begin());
  const std::string_view meant = closest_match(name, kModes);
  return Error{ErrorCode::usage, "unknown progress mode \"" + std::string(name) + "\"", "",
               meant.empty() ? "auto, bar, plain, json or none"
                             : "did you mean \"" + std::string(meant) + "\"?"};
}

ProgressMode effective_mode(ProgressMode asked, const Terminal& terminal) {
  if (asked != ProgressMode::automatic) return asked;
  return terminal.kind == Terminal::Kind::interactive ? ProgressMode::bar : ProgressMode::plain;
}

Progress::Progress(ProgressMode mode, Terminal terminal, Sink sink, Clock clock)
    : mode_(effective_mode(mode, terminal)),
      terminal_(terminal),
      sink_(std::move(sink)),
      clock_(std::move(clock)) {}

Progress::Progress(ProgressMode mode)
    : Progress(mode, terminal_of(STDERR_FILENO), write_to_stderr, std::chrono::steady_clock::now) {}

void Progress::start(const ProgressTotals& totals) {
  const std::lock_guard lock(mutex_);
  totals_ = totals;
  start_ = clock_();
  // A run that is over before the first interval shows no bar at all.
  next_update_ns_ = nanoseconds(start_ + kUpdateInterval);
  if (mode_ != ProgressMode::json) return;
  emit("start", fmt::format(R"("version": 1, "panoramas": {}, "up_to_date": {}, "bytes": {})",
                            totals.panoramas, totals.up_to_date, totals.bytes));
}

void Progress::begin_panorama(std::string_view name) {
  if (mode_ != ProgressMode::bar) return;
  const std::lock_guard lock(mutex_);
  name_ = printable(name);
}

void Progress::end_panorama(const PanoramaEvent& event) {
  {
    const std::lock_guard lock(mutex_);
    switch (event.outcome) {
      case PanoramaOutcome::done:
        ++done_;
        break;
      case PanoramaOutcome::failed:
        ++failed_;
        break;
      case PanoramaOutcome::up_to_date:
        ++up_to_date_;
        break;
    }
    if (event.outcome != PanoramaOutcome::up_to_date) bytes_done_ += event.bytes;
    if (mode_ == ProgressMode::json) {
      std::string fields = fmt::format(
          R"("name": {}, "status": "{}", "seconds": {:.6f}, "pixels": {}, "bytes": {}, )"
          R"("finished": {}, "panoramas": {})",
          json_quoted(event.name), name_of(event.outcome), event.seconds, event.pixels, event.bytes,
          done_ + failed_, totals_.panoramas);
      if (event.outcome == PanoramaOutcome::failed) {
        fields += ", \"error\": " + json_quoted(event.error);
      }
      if (!event.warnings.empty()) fields += ", \"warnings\": " + json_list(event.warnings);
      emit("panorama", fields);
    }
  }
  tick();
}

void Progress::tick() {
  if (mode_ == ProgressMode::json || mode_ == ProgressMode::none) return;
  const TimePoint now = clock_();
  if (nanoseconds(now) < next_update_ns_.load(std::memory_order_relaxed)) return;
  const std::lock_guard lock(mutex_);
  if (nanoseconds(now) < next_update_ns_) return;  // another thread was here meanwhile
  next_update_ns_ = nanoseconds(now + kUpdateInterval);
  update();
}

void Progress::message(std::string_view line) {
  const std::lock_guard lock(mutex_);
  if (mode_ == ProgressMode::json) {
    emit("message", "\"text\": " + json_quoted(line));
    return;
  }
  std::string text = bar_shown_ ? kClearLine : "";
  text.append(line).append("\n");
  if (bar_shown_) text += bar_line();
  sink_(text);
}

void Progress::end() {
  const std::lock_guard lock(mutex_);
  if (mode_ == ProgressMode::json) {
    emit("end",
         fmt::format(R"("done": {}, "failed": {}, "up_to_date": {}, "pixels": {}, "bytes": {})",
                     done_, failed_, totals_.up_to_date, pixels_done_.load(), bytes_done_));
  }
  if (std::exchange(bar_shown_, false)) sink_(kClearLine);
  if (plain_tenths_ >= 0) print_plain();
}

double Progress::elapsed() const {
  return std::chrono::duration<double>(clock_() - start_).count();
}

// By bytes where they are known: panoramas differ too much in size to be counted.
double Progress::fraction() const {
  if (totals_.bytes > 0) {
    return std::min(1.0, static_cast<double>(bytes_done_) / static_cast<double>(totals_.bytes));
  }
  if (totals_.panoramas == 0) return 1.0;
  return static_cast<double>(done_ + failed_) / static_cast<double>(totals_.panoramas);
}

int Progress::tenths_done() const { return static_cast<int>(10.0 * fraction()); }

Progress::Rates Progress::rates() const {
  Rates rates;
  const double seconds = elapsed();
  if (seconds <= 0.0) return rates;
  rates.megapixels = static_cast<double>(pixels_done_.load()) / seconds / 1e6;
  rates.megabytes = static_cast<double>(bytes_done_) / seconds / 1e6;
  const double part = fraction();
  if (part > 0.0) rates.remaining = seconds * (1.0 - part) / part;
  return rates;
}

std::string Progress::bar_line() const {
  const Rates rate = rates();
  const double part = fraction();
  std::string line =
      fmt::format("{}/{} {:3.0f}%", done_ + failed_, totals_.panoramas, std::floor(100.0 * part));
  if (terminal_.columns >= kColumnsForBar) {
    const int filled = static_cast<int>(part * kBarCells);
    line += fmt::format(" [{:<{}}]", std::string(filled, '='), kBarCells);
  }
  line += fmt::format(" {:.1f} Mpixel/s {:.1f} MB/s", rate.megapixels, rate.megabytes);
  if (rate.remaining >= 0.0) line += " ETA " + duration_text(rate.remaining);
  const std::string failures = failed_ > 0 ? fmt::format(" {} failed", failed_) : "";

  // The last column stays free: some terminals wrap when it is filled.
  const auto columns = static_cast<std::size_t>(std::max(1, terminal_.columns - 1));
  if (line.size() + failures.size() > columns) return line.substr(0, columns);
  const std::size_t left = columns - line.size() - failures.size();
  line += styled(terminal_, Style::red, failures);
  constexpr std::size_t kShortestName = 8;
  if (!name_.empty() && left > kShortestName) {
    line += ' ' + styled(terminal_, Style::dim, fitted_end(name_, left - 1));
  }
  return line;
}

std::string Progress::plain_line() const {
  const Rates rate = rates();
  std::string line = fmt::format("{} of {} panoramas ({:.0f} %)", done_ + failed_,
                                 totals_.panoramas, std::floor(100.0 * fraction()));
  if (failed_ > 0) line += fmt::format(", {} failed", failed_);
  line += fmt::format(", {:.1f} Mpixel/s, {:.1f} MB/s", rate.megapixels, rate.megabytes);
  line += ", " + duration_text(elapsed()) + " so far";
  if (rate.remaining > 0.0) line += ", ETA " + duration_text(rate.remaining);
  return line + '\n';
}

void Progress::update() {
  if (mode_ == ProgressMode::bar) {
    draw_bar();
    return;
  }
  if (plain_tenths_ < 0) {
    if (elapsed() >= kQuietSeconds) print_plain();
    return;
  }
  const double since = elapsed() - plain_time_;
  const int tenths = tenths_done();
  // The last tenth is told by end().
  const bool more = tenths > plain_tenths_ && tenths < 10;
  if ((more && since >= kPlainShortSeconds) || since >= kPlainSeconds) print_plain();
}

void Progress::draw_bar() {
  bar_shown_ = true;
  sink_(kClearLine + bar_line());
}

void Progress::print_plain() {
  plain_time_ = elapsed();
  plain_tenths_ = tenths_done();
  sink_(plain_line());
}

void Progress::emit(std::string_view event, std::string_view fields) {
  sink_(fmt::format("{{\"event\": \"{}\", \"elapsed\": {:.6f}, {}}}\n", event, elapsed(), fields));
}

}  // namespace shoal
