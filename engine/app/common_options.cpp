#include "app/common_options.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <functional>
#include <memory>

#include "app/messages.h"
#include "batch/scheduler.h"
#include "kernels/targets.h"

namespace shoal {
namespace {

template <typename T>
void add_once(std::vector<T>& list, T value) {
  if (std::ranges::find(list, value) == list.end()) list.push_back(value);
}

// What the manifest's reader has made sure of for the manifest as it stands.
Status check_degrees(const Manifest& manifest) {
  for (const ExportRequest& request : manifest.exports) {
    SHOAL_RETURN_IF_ERROR(check_export_degree(manifest, request));
  }
  if (std::ranges::find(manifest.tables, TableFormat::npy) == manifest.tables.end()) return {};
  const auto degree = [](const PanoramaEntry& entry) { return entry.settings->projection.degree; };
  const bool differ = std::ranges::adjacent_find(manifest.entries, std::not_equal_to{}, degree) !=
                      manifest.entries.end();
  if (!differ) return {};
  return Error{ErrorCode::usage, "an npy table has one degree, but the panoramas have several",
               manifest.path.string(), "give one with --degree, or leave npy out"};
}

EntrySettings overridden(const ComputeChoice& choice, EntrySettings settings) {
  ProjectionSettings& projection = settings.projection;
  if (choice.degree) projection.degree = *choice.degree;
  if (choice.quadrature) projection.quadrature = *choice.quadrature;
  if (choice.layout) projection.layout = *choice.layout;
  projection.arithmetic = choice.arithmetic;
  if (choice.frame) settings.linear.frame = choice.frame;
  return settings;
}

}  // namespace

void add_compute_options(CLI::App& command, ComputeOptions& options) {
  command.add_option("-j,--threads", options.threads, "Workers; as many as processors by default")
      ->check(CLI::Range(1, 1024));
  command.add_option("--target", options.target,
                     "SIMD target, one of `shoal targets`; changes speed, never a bit");
  command.add_flag("--reference", options.reference,
                   "Compute with the long-double twin: slow, obviously correct");
  command.add_option("--degree", options.degree, "Highest degree L, 0 to 64")
      ->check(CLI::Range(0, kMaxDegree));
  command.add_option("--quadrature", options.quadrature, "texel, midpoint or fejer");
  command.add_option("--layout", options.layout,
                     "Layout of the pictures: auto, equirect (the default), cube-vertical-cross, "
                     "cube-horizontal-cross, cube-vertical-strip, cube-horizontal-strip, "
                     "cube-faces, cube-openexr, angular, mirror-ball, octahedral or "
                     "octahedral-equal-area");
  command
      .add_option("--quantity", options.quantities,
                  "radiance, irradiance or irradiance-over-pi; may be repeated")
      ->allow_extra_args(false);
  command.add_option("--frame", options.frame,
                     "Frame of the coefficients: a name, or where the panorama's centre, right and "
                     "up point, such as +z,-x,+y");
}

Result<ComputeChoice> understand(const ComputeOptions& options) {
  ComputeChoice choice;
  choice.threads = options.threads > 0 ? options.threads : default_thread_count();
  choice.degree = options.degree;
  if (options.reference) choice.arithmetic = Arithmetic::reference;
  if (!options.target.empty()) SHOAL_RETURN_IF_ERROR(kernels::force_target(options.target));
  if (!options.quadrature.empty()) {
    SHOAL_ASSIGN_OR_RETURN(quadrature, parse_quadrature(options.quadrature));
    if (quadrature == Quadrature::clenshaw_curtis) {
      return Error{ErrorCode::usage, "clenshaw-curtis cannot be asked for", "",
                   "it is used by itself where a file's border pixels lie on the poles"};
    }
    choice.quadrature = quadrature;
  }
  if (!options.layout.empty()) {
    SHOAL_ASSIGN_OR_RETURN(layout, parse_layout(options.layout));
    choice.layout = layout;
  }
  for (const std::string& name : options.quantities) {
    SHOAL_ASSIGN_OR_RETURN(quantity, parse_quantity(name));
    add_once(choice.quantities, quantity);
  }
  if (!options.frame.empty()) {
    SHOAL_ASSIGN_OR_RETURN(frame, parse_frame(options.frame));
    choice.frame = frame;
  }
  for (const std::string& name : options.formats) {
    for (const TableFormat format : {TableFormat::csv, TableFormat::json, TableFormat::npy}) {
      if (name == name_of(format)) add_once(choice.formats, format);
    }
  }
  return choice;
}

Status override_manifest(const ComputeChoice& choice, Manifest& manifest) {
  // Entries that share their settings follow one another, and share them afterwards as well.
  std::shared_ptr<const EntrySettings> before;
  std::shared_ptr<const EntrySettings> after;
  for (PanoramaEntry& entry : manifest.entries) {
    if (entry.settings != before) {
      before = entry.settings;
      after = std::make_shared<EntrySettings>(overridden(choice, *before));
    }
    entry.settings = after;
  }
  if (choice.frame) {
    for (Variant& variant : manifest.variants) variant.linear.frame = choice.frame;
  }
  if (!choice.quantities.empty()) manifest.quantities = choice.quantities;
  if (!choice.formats.empty()) manifest.tables = choice.formats;
  return check_degrees(manifest);
}

void add_manifest_options(CLI::App& command, ManifestOptions& options) {
  command.add_option("MANIFEST", options.path, "The manifest, a YAML file")->required();
  command
      .add_option("--set", options.sets,
                  "NAME=VALUE: gives a variable of the manifest a value; may be repeated")
      ->allow_extra_args(false)
      ->check([](const std::string& text) {
        return text.find('=') == std::string::npos || text.front() == '='
                   ? "\"" + text + "\" is not NAME=VALUE"
                   : std::string();
      });
  command.add_option("--only", options.only, "Only panoramas with a name or tag like this glob");
  command.add_flag("--force", options.force, "Process what is up to date, too");
  command.add_flag("--verify-inputs", options.verify_inputs,
                   "Hash every file; else unchanged size and time stand for unchanged content");
}

std::optional<Manifest> load_and_report(const ManifestOptions& options) {
  LoadOptions load;
  for (const std::string& set : options.sets) {
    const std::size_t equals = set.find('=');
    load.sets.emplace_back(set.substr(0, equals), set.substr(equals + 1));
  }
  ManifestResult result = load_manifest(options.path, load);
  fmt::print(stderr, "{}", result.messages);
  if (!result.manifest) {
    fmt::print(stderr, "{} {} in {}; nothing was run\n", result.error_count,
               result.error_count == 1 ? "error" : "errors", options.path);
  }
  return std::move(result.manifest);
}

}  // namespace shoal
