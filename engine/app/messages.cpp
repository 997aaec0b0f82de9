#include "app/messages.h"

#include <fmt/format.h>
#include <unistd.h>

#include <cstdio>

#include "batch/store.h"
#include "core/terminal.h"

namespace shoal {
namespace {

// More than this many lines would hide everything else; the store has what they say.
constexpr std::size_t kMaxNotes = 20;

void print_some(Style style, std::string_view label, const std::vector<PanoramaNote>& notes) {
  for (std::size_t i = 0; i < notes.size() && i < kMaxNotes; ++i) {
    print_message(style, label, notes[i].panorama + ": " + notes[i].text);
  }
  if (notes.size() > kMaxNotes) {
    print_message(style, label,
                  fmt::format("and {} more; the store has them all", notes.size() - kMaxNotes));
  }
}

void print_line(std::string_view line) { fmt::print(stderr, "{}\n", line); }

std::string counted(std::int64_t count, std::string_view what) {
  return fmt::format("{} {}{}", count, what, count == 1 ? "" : "s");
}

}  // namespace

void print_error(const Error& error) { print_message(Style::red, "error:", error.text()); }

void FileNotes::add_layout(const std::string& file, const std::string& recognised) {
  if (!recognised.empty()) layouts.push_back({file, recognised});
}

void FileNotes::add_warnings(const std::string& file, const std::vector<std::string>& texts) {
  for (const std::string& text : texts) warnings.push_back({file, text});
}

void FileNotes::add_failure(const std::string& file, const Error& error) {
  if (error.code != ErrorCode::interrupted) failures.push_back({file, error.text()});
}

void print_notes(const FileNotes& notes) {
  print_some(Style::bold, "note:", notes.layouts);
  print_some(Style::yellow, "warning:", notes.warnings);
  for (const PanoramaNote& failure : notes.failures) {
    print_message(Style::red, "failed:", failure.text);
  }
}

void print_summary(const RunSummary& summary, const Manifest& manifest) {
  std::string line = styled(terminal_of(STDERR_FILENO), Style::bold,
                            counted(summary.done_count, "panorama") + " done");
  if (summary.up_to_date_count > 0)
    line += fmt::format(", {} up to date", summary.up_to_date_count);
  if (!summary.failures.empty()) line += fmt::format(", {} failed", summary.failures.size());
  if (summary.pixel_count > 0 && summary.seconds > 0.0) {
    line += fmt::format(" in {:.3g} s: {:.3g} Mpixel/s, {:.3g} MB/s of files", summary.seconds,
                        static_cast<double>(summary.pixel_count) / 1e6 / summary.seconds,
                        static_cast<double>(summary.byte_count) / 1e6 / summary.seconds);
  }
  print_line(line);
  if (summary.interrupted) {
    print_line("interrupted; what is finished is kept, and the same command goes on from there");
    return;
  }
  if (summary.missing_count > 0) {
    print_line(
        fmt::format("{} of the manifest not in the tables: failed, or not run with these "
                    "parameters yet",
                    counted(summary.missing_count, "panorama")));
  }
  for (const std::string& table : summary.tables) print_line("  table  " + table);
  if (!manifest.maps.empty() || summary.map_count > 0) {  // pictures lie there, too
    print_line(fmt::format("  maps   {}/maps ({} written)", manifest.output.string(),
                           counted(summary.map_count, "file")));
  }
  if (!manifest.exports.empty()) {
    print_line(fmt::format("  files  {}/exports ({} written)", manifest.output.string(),
                           counted(summary.export_count, "file")));
  }
  print_line(fmt::format("  store  {}/{}", manifest.output.string(), kStoreFileName));
}

}  // namespace shoal
