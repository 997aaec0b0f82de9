#include <fmt/format.h>

#include <atomic>
#include <charconv>
#include <cstdio>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "app/commands.h"
#include "app/common_options.h"
#include "app/in_order.h"
#include "app/interrupt.h"
#include "app/messages.h"
#include "batch/measured_error.h"
#include "batch/scheduler.h"
#include "batch/variant_light.h"
#include "output/quality_table.h"

namespace shoal {
namespace {

struct QualityCommand {
  std::vector<std::string> files;
  ComputeOptions compute;
  int error_degree = 32;
  std::string window = "none";
  bool brute_force = false;
  int rows = 129;
  std::string format = "csv";
};

// How every file is looked at.
struct QualityChoice {
  ComputeChoice compute;
  std::shared_ptr<const EntrySettings> settings;
  int brute_force_rows = 0;  // 0: none
  bool json = false;
};

// "KIND" or "KIND:PARAMETER".
Result<WindowKey> window_named(const std::string& text) {
  if (text == "auto") return WindowKey{WindowFit::automatic, {}};
  const std::size_t colon = text.find(':');
  const Result<WindowKind> kind = parse_window_kind(text.substr(0, colon));
  if (!kind) {
    return Error{ErrorCode::usage, kind.error().what, "--window", kind.error().hint + "; or auto"};
  }
  DegreeWindow window{*kind, {}};
  if (colon == text.npos) return WindowKey{WindowFit::given, window};
  const char* const end = text.data() + text.size();
  double parameter = 0.0;
  const auto [rest, code] = std::from_chars(text.data() + colon + 1, end, parameter);
  if (code != std::errc() || rest != end || !(parameter > 0.0) || *kind == WindowKind::none) {
    return Error{ErrorCode::usage, text + " is no window with a number above 0", "--window",
                 "such as hann:4"};
  }
  window.parameter = parameter;
  return WindowKey{WindowFit::given, window};
}

Result<QualityChoice> understand(const QualityCommand& command) {
  QualityChoice choice;
  SHOAL_ASSIGN_OR_RETURN(compute, understand(command.compute));
  SHOAL_ASSIGN_OR_RETURN(window, window_named(command.window));
  choice.compute = compute;
  EntrySettings settings;
  const int degree = compute.degree.value_or(settings.projection.degree);
  if (command.error_degree <= degree && !command.brute_force) {
    return Error{ErrorCode::usage,
                 fmt::format("the exact irradiance must be known beyond degree {}", degree),
                 "--error-degree", "give a higher degree, such as 32"};
  }
  ProjectionSettings& projection = settings.projection;
  projection.degree = degree;
  projection.quadrature = compute.quadrature.value_or(projection.quadrature);
  projection.layout = compute.layout.value_or(projection.layout);
  projection.quality_degree = command.error_degree;
  settings.linear.window = window;
  choice.settings = std::make_shared<EntrySettings>(std::move(settings));
  choice.brute_force_rows = command.brute_force ? command.rows : 0;
  choice.json = command.format == "json";
  return choice;
}

// Tells on standard error how far a slow integral is, a line for every tenth.
std::function<void(double)> progress_of(const std::string& file) {
  return [file, told = 0](double share) mutable {
    if (share * 10 < told + 1) return;
    told = static_cast<int>(share * 10);
    fmt::print(stderr, "{}: {} %\n", printable(file), told * 10);
  };
}

Result<QualityRecord> figures_of(const std::string& file, const Projection& projection,
                                 const QualityChoice& choice, const std::atomic<bool>& stop) {
  PanoramaEntry entry;
  entry.name = entry.file = file;
  entry.settings = choice.settings;
  QualityRecord record;
  record.panorama = file;
  record.frame = choice.compute.frame.value_or(Frame{});
  record.nonfinite_pixels = projection.pixels.nonfinite_count;
  record.negative_pixels = projection.pixels.negative_count;
  record.clamped_pixels = projection.pixels.clamped_count;
  VariantLights lights(projection, entry);
  SHOAL_ASSIGN_OR_RETURN(light, lights.in({}));
  SHOAL_ASSIGN_OR_RETURN(quality, lights.quality({}, light));
  record.quality = std::move(quality);
  if (choice.brute_force_rows > 0) {
    SHOAL_ASSIGN_OR_RETURN(error, measured_error(file, light.radiance, choice.settings->projection,
                                                 choice.brute_force_rows, choice.compute.threads,
                                                 progress_of(file), stop));
    record.quality.error = error;
  }
  return record;
}

// What is found of a file.
struct Findings {
  Result<QualityRecord> record;
  std::string layout;  // that was recognised
  std::vector<std::string> warnings;
};

// Prints findings in the order in which they are taken.
class FigurePrinter {
 public:
  FigurePrinter(const std::vector<std::string>& files, const QualityChoice& choice)
      : files_(files), json_(choice.json) {
    if (!json_) fmt::print("{}", quality_csv_header(VariantColumn::absent));
    if (json_) fmt::print("{{\n\"schema\": \"shoal/quality\",\n\"version\": 1,\n\"records\": [");
  }

  void take(std::size_t index, const Findings& found) {
    const std::string& file = files_[index];
    notes_.add_warnings(file, found.warnings);
    if (!json_) notes_.add_layout(file, found.layout);
    if (!found.record) {
      notes_.add_failure(file, found.record.error());
    } else if (json_) {
      fmt::print("{}{}", printed_++ == 0 ? "\n" : ",\n",
                 quality_json(*found.record, VariantColumn::absent));
    } else {
      fmt::print("{}", quality_csv_row(*found.record, VariantColumn::absent));
    }
  }

  void end() const {
    if (json_) fmt::print("\n]\n}}\n");
  }

  [[nodiscard]] const FileNotes& notes() const { return notes_; }

 private:
  const std::vector<std::string>& files_;
  const bool json_;
  std::int64_t printed_ = 0;
  FileNotes notes_;
};

int print_quality(const QualityCommand& command) {
  const Result<QualityChoice> choice = understand(command);
  if (!choice) {
    print_error(choice.error());
    return kExitUsage;
  }
  FigurePrinter printer(command.files, *choice);
  InOrder<Findings> findings(command.files.size(), [&](std::size_t index, const Findings& found) {
    printer.take(index, found);
  });
  ProjectionTables tables;
  const std::atomic<bool>& stop = stop_on_interrupt();
  std::atomic<std::int64_t> pixels_done{0};
  JobSteps steps;
  steps.open = [&](std::size_t index) {
    return PanoramaProjection::open(command.files[index], {}, choice->settings->projection, tables);
  };
  steps.finish = [&](std::size_t index, PanoramaProjection* projection, Status status) {
    auto found = status ? projection->finish() : Result<Projection>(std::move(status).error());
    if (!found) return findings.bring(index, {std::move(found).error(), "", {}});
    findings.bring(index, {figures_of(command.files[index], *found, *choice, stop),
                           found->recognised_layout, found->warnings});
  };
  // Brute force spreads one panorama over the threads.
  run_jobs(command.files.size(), choice->brute_force_rows > 0 ? 1 : choice->compute.threads, stop,
           pixels_done, steps);
  printer.end();
  print_notes(printer.notes());
  if (stop) return kExitInterrupted;
  return printer.notes().failures.empty() ? kExitOk : kExitFailed;
}

}  // namespace

void add_quality_options(CLI::App& command, Action& action) {
  auto options = std::make_shared<QualityCommand>();
  ComputeOptions& compute = options->compute;
  command.add_option("FILE", options->files, "Panoramas")->required();
  command.add_option("--degree", compute.degree, "Highest degree L, 0 to 64; 2 by default")
      ->check(CLI::Range(0, kMaxDegree));
  command
      .add_option("--error-degree", options->error_degree,
                  "Degree to which the exact irradiance is known, 32 by default; above L")
      ->check(CLI::Range(0, kMaxDegree));
  command.add_option("--window", options->window,
                     "none (the default), hann, lanczos, gauss, laplacian or auto; with its "
                     "parameter as hann:4");
  command.add_flag("--brute-force", options->brute_force,
                   "Errors against the hemisphere integral over all texels: slow, without any "
                   "harmonics; equirect pictures only");
  command
      .add_option("--rows", options->rows,
                  "Of --brute-force: R x 2R directions, 129 rows by default; time grows with R^2")
      ->check(CLI::Range(1, 1025));
  command.add_option("--quadrature", compute.quadrature, "texel, midpoint or fejer");
  command.add_option("--layout", compute.layout, "Layout of the pictures, as for `project`");
  command.add_option("--frame", compute.frame,
                     "Frame of the directions: a name, or where the panorama's centre, right and "
                     "up point, such as +z,-x,+y");
  command.add_option("--format", options->format, "csv (the default) or json")
      ->check(CLI::IsMember({"csv", "json"}));
  command.add_option("-j,--threads", compute.threads, "Workers; as many as processors by default")
      ->check(CLI::Range(1, 1024));
  command.add_option("--target", compute.target,
                     "SIMD target, one of `shoal targets`; changes speed, never a bit");
  command.callback([&action, options] { action = [options] { return print_quality(*options); }; });
}

}  // namespace shoal
