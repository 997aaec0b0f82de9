// Options that several commands share.
#pragma once

#include <CLI/CLI.hpp>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "batch/manifest.h"
#include "core/result.h"
#include "output/coefficient_table.h"
#include "sphere/frame.h"
#include "sphere/irradiance.h"
#include "sphere/layout.h"
#include "sphere/quadrature.h"

namespace shoal {

// How to compute: `run` and `project`. What is not given stays with the manifest or the default.
struct ComputeOptions {
  int threads = 0;  // 0: as many as there are processors
  std::string target;
  bool reference = false;
  std::optional<int> degree;
  std::string quadrature;
  std::string layout;
  std::vector<std::string> quantities;
  std::string frame;
  std::vector<std::string> formats;
};

void add_compute_options(CLI::App& command, ComputeOptions& options);

// The same, understood.
struct ComputeChoice {
  int threads = 1;
  std::optional<int> degree;
  std::optional<Quadrature> quadrature;
  std::optional<Layout> layout;
  std::vector<Quantity> quantities;
  std::optional<Frame> frame;
  std::vector<TableFormat> formats;
  Arithmetic arithmetic = Arithmetic::kernels;
};

// Forces the SIMD target, too. Errors: usage.
Result<ComputeChoice> understand(const ComputeOptions& options);

// Lets what the command line says win over the manifest. Error: usage (the two don't go together).
Status override_manifest(const ComputeChoice& choice, Manifest& manifest);

// Which manifest, and how it is read: `run` and `check`.
struct ManifestOptions {
  std::string path;
  std::vector<std::string> sets;  // NAME=VALUE
  std::string only;
  bool force = false;
  bool verify_inputs = false;
};

void add_manifest_options(CLI::App& command, ManifestOptions& options);

// Reads the manifest; what is wrong with it has been printed when nothing comes back.
std::optional<Manifest> load_and_report(const ManifestOptions& options);

}  // namespace shoal
