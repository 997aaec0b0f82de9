// Coefficient tables as panoramas.
#pragma once

#include <filesystem>
#include <string_view>
#include <vector>

#include "core/result.h"
#include "library/library.h"
#include "output/coefficient_table.h"

namespace shoal::viz {

// What shoal calls the tables in an output folder.
inline constexpr std::string_view kJsonTableName = "coefficients.json";
inline constexpr std::string_view kCsvTableName = "coefficients.csv";

// All records of a CSV or JSON table, as they stand there. CSV does not tell a frame: its records
// say native. Errors: not_found, unreadable, malformed, unsupported (npy).
[[nodiscard]] Result<std::vector<CoefficientRecord>> read_table(const std::filesystem::path& path);

// One panorama for each panorama and variant of the records, in the order in which these come
// first: its radiance where there is one, else what there is of it. A name that is a file's path
// gives the panorama that file.
[[nodiscard]] std::vector<Panorama> panoramas_of(std::vector<CoefficientRecord> records);

}  // namespace shoal::viz
