// What is known of a panorama's light and of how well its coefficients stand for it, as text.
//
// CSV   `panorama,variant,degree,error_degree,rms_error,max_error,minimum_irradiance,
//       negative_fraction,contrast,mean_r,mean_g,mean_b,directionality,dominant_x,dominant_y,
//       dominant_z,dominant_r,dominant_g,dominant_b,dominant_energy,key_temperature,
//       fill_temperature,energy_shares,window_gains,nonfinite_pixels,negative_pixels,
//       clamped_pixels`: sphere/light_quality.h says what they are. One row a record, RFC 4180
//       quoting, "\n" line ends; a figure that the light does not have is empty; several numbers in
//       a column (a degree each) are separated by blanks. What `shoal quality` prints has no
//       variant.
// JSON  {"schema": "shoal/quality", "version": 1, "records": [{...}, ...]} with the same names;
//       null for what is empty, lists for several numbers.
// Numbers are written like C's "%.17g", so they read back as the same double.
#pragma once

#include <cstdint>
#include <string>

#include "output/coefficient_table.h"
#include "sphere/frame.h"
#include "sphere/light_quality.h"

namespace shoal {

struct QualityRecord {
  std::string panorama;
  std::string variant;   // empty where the table has no such column
  LightQuality quality;  // directions in the native frame
  Frame frame;           // that its directions are told in
  std::int64_t nonfinite_pixels = 0;
  std::int64_t negative_pixels = 0;
  std::int64_t clamped_pixels = 0;
};

// The header line of CSV.
[[nodiscard]] std::string quality_csv_header(VariantColumn variant);

// A line of CSV, or an object of JSON without a line end.
[[nodiscard]] std::string quality_csv_row(const QualityRecord& record, VariantColumn variant);
[[nodiscard]] std::string quality_json(const QualityRecord& record, VariantColumn variant);

}  // namespace shoal
