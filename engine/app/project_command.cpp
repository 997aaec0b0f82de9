#include <fmt/format.h>

#include <cstdio>
#include <memory>
#include <mutex>
#include <optional>

#include "app/commands.h"
#include "app/common_options.h"
#include "app/in_order.h"
#include "app/interrupt.h"
#include "app/messages.h"
#include "app/profile_export.h"
#include "batch/scheduler.h"
#include "core/input_file.h"

namespace shoal {
namespace {

struct ProjectCommand {
  std::vector<std::string> files;
  ComputeOptions compute;
  ProfileOptions profile;
};

// Writes projections to a table, and remembers what is to be said of them.
class ProjectionTable {
 public:
  ProjectionTable(const std::vector<std::string>& files, const ComputeChoice& choice,
                  TableWriter& writer)
      : files_(files), choice_(choice), writer_(writer) {}

  void take(std::size_t index, const Result<Projection>& result) {
    const std::string& file = files_[index];
    if (!result) return notes_.add_failure(file, result.error());
    notes_.add_warnings(file, result->warnings);
    notes_.add_layout(file, result->recognised_layout);
    const Frame frame = choice_.frame.value_or(Frame{});
    const Coefficients radiance = to_frame(result->radiance, frame);
    for (const Quantity quantity : choice_.quantities) {
      if (write_status_) {
        write_status_ =
            writer_.append({file, "", quantity, apply_quantity(radiance, quantity), frame});
      }
    }
  }

  [[nodiscard]] FileNotes& notes() { return notes_; }
  [[nodiscard]] const Status& write_status() const { return write_status_; }

 private:
  const std::vector<std::string>& files_;
  const ComputeChoice& choice_;
  TableWriter& writer_;
  Status write_status_;
  FileNotes notes_;
};

bool is_for_programs(const ComputeChoice& choice) {
  return !choice.formats.empty() && choice.formats.front() == TableFormat::json;
}

Status write_to_stdout(std::string_view text) {
  if (std::fwrite(text.data(), 1, text.size(), stdout) == text.size()) return {};
  return Error{ErrorCode::write_failed, "cannot be written", "standard output", ""};
}

ProjectionSettings settings_of(const ComputeChoice& choice) {
  ProjectionSettings settings;
  settings.degree = choice.degree.value_or(settings.degree);
  settings.quadrature = choice.quadrature.value_or(settings.quadrature);
  settings.arithmetic = choice.arithmetic;
  settings.layout = choice.layout.value_or(settings.layout);
  return settings;
}

int project_files(const std::vector<std::string>& files, const ComputeChoice& choice,
                  TableWriter& writer) {
  ProjectionTable table(files, choice, writer);
  InOrder<Result<Projection>> results(
      files.size(), [&](std::size_t index, auto& result) { table.take(index, result); });
  ProjectionTables tables;
  const std::atomic<bool>& stop = stop_on_interrupt();
  std::atomic<std::int64_t> pixels_done{0};
  JobSteps steps;
  steps.open = [&](std::size_t index) {
    return PanoramaProjection::open(files[index], {}, settings_of(choice), tables);
  };
  steps.prefetch = [&](std::size_t index, std::uint64_t limit) {
    prefetch_file(files[index], limit);
  };
  steps.finish = [&](std::size_t index, PanoramaProjection* projection, Status status) {
    results.bring(index,
                  status ? projection->finish() : Result<Projection>(std::move(status).error()));
  };
  run_jobs(files.size(), choice.threads, stop, pixels_done, steps);
  Status written = table.write_status() ? Status() : Status(table.write_status().error());
  if (written) {
    if (auto committed = writer.commit(); !committed) written = std::move(committed).error();
  }
  if (is_for_programs(choice)) table.notes().layouts.clear();
  print_notes(table.notes());
  if (!written) print_error(written.error());
  if (stop) return kExitInterrupted;
  return table.notes().failures.empty() && written ? kExitOk : kExitFailed;
}

Result<std::unique_ptr<TableWriter>> make_writer(const ProjectCommand& command,
                                                 ComputeChoice& choice) {
  const ProfileOptions& profile = command.profile;
  if (!profile.profile.empty()) {
    return profile_writer(profile, command.files.size(), choice, write_to_stdout);
  }
  if (!profile.choices.empty()) {
    return Error{ErrorCode::usage, "--option is for --profile", "", "name the profile, too"};
  }
  if (choice.quantities.empty()) choice.quantities = {Quantity::radiance};
  const TableFormat format = choice.formats.empty() ? TableFormat::csv : choice.formats.front();
  return stream_table(format, write_to_stdout, VariantColumn::absent);
}

int project(const ProjectCommand& command) {
  Result<ComputeChoice> choice = understand(command.compute);
  if (!choice) {
    print_error(choice.error());
    return kExitUsage;
  }
  auto writer = make_writer(command, *choice);
  if (!writer) {
    print_error(writer.error());
    return kExitUsage;
  }
  return project_files(command.files, *choice, **writer);
}

}  // namespace

void add_project_options(CLI::App& command, Action& action) {
  auto options = std::make_shared<ProjectCommand>();
  command.add_option("FILE", options->files, "Panoramas")->required();
  add_compute_options(command, options->compute);
  add_profile_options(command, options->profile);
  command.add_option("--format", options->compute.formats, "csv (the default) or json")
      ->check(CLI::IsMember({"csv", "json"}))
      ->expected(1);
  command.callback([&action, options] { action = [options] { return project(*options); }; });
}

}  // namespace shoal
