// Coefficient tables as panoramas.
#pragma once

#include <filesystem>
#include <vector>

#include "core/result.h"
#include "library/library.h"
#include "output/coefficient_table.h"

namespace shoal::viz {

// All records of a CSV or JSON table, as they stand there. CSV does not tell a frame, and what it
// holds is taken for native. Errors: not_found, unreadable, malformed, unsupported (npy).
[[nodiscard]] Result<std::vector<CoefficientRecord>> read_table(const std::filesystem::path& path);

// One panorama for each panorama and variant of the records, in the order in which these come
// first: its radiance where there is one, else what there is of it. A name that is a file's path
// gives the panorama that file.
[[nodiscard]] std::vector<Panorama> panoramas_of(std::vector<CoefficientRecord> records);

}  // namespace shoal::viz
