// Made-up records, and ways to write them, for the tests of the tables.
#pragma once

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <limits>
#include <random>
#include <string>
#include <vector>

#include "output/coefficient_table.h"

namespace shoal::test {

// 1, 2, 3, ... over index, then channel.
inline CoefficientRecord counting_record(const std::string& panorama, const std::string& variant,
                                         Quantity quantity, int degree) {
  CoefficientRecord record{panorama, variant, quantity, Coefficients(degree), Frame()};
  double next = 1.0;
  for (int i = 0; i < coefficient_count(degree); ++i) {
    for (auto& channel : record.coefficients.channels) channel[i] = next++;
  }
  return record;
}

// Random bit patterns, so every exponent comes up; the first are the corners of the format.
inline CoefficientRecord nasty_record(const std::string& panorama, unsigned seed, int degree) {
  using limits = std::numeric_limits<double>;
  const double corners[] = {-0.0,
                            0.0,
                            limits::denorm_min(),
                            -limits::denorm_min(),
                            limits::min(),
                            std::nextafter(limits::min(), 0.0),
                            limits::max(),
                            limits::lowest(),
                            1e308,
                            0.1,
                            1.0 / 3.0,
                            std::nextafter(1.0, 2.0),
                            9007199254740993.0,
                            123456789012345680.0,
                            1e22,
                            1e23,
                            1e-5,
                            5e-5};
  CoefficientRecord record{panorama, "v", Quantity::irradiance, Coefficients(degree), Frame()};
  std::mt19937_64 random(seed);
  std::size_t taken = 0;
  for (auto& channel : record.coefficients.channels) {
    for (double& value : channel) {
      do {
        value = taken < std::size(corners) ? corners[taken] : std::bit_cast<double>(random());
        ++taken;
      } while (!std::isfinite(value));
    }
  }
  return record;
}

inline std::string bytes_of(const std::filesystem::path& path) {
  std::ifstream stream(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), {}};
}

inline std::string streamed(TableFormat format, VariantColumn variant,
                            const std::vector<CoefficientRecord>& records) {
  std::string text;
  auto table = stream_table(
      format,
      [&](std::string_view piece) {
        text += piece;
        return Status();
      },
      variant);
  EXPECT_TRUE(table.ok());
  for (const auto& record : records) EXPECT_TRUE((*table)->append(record).ok());
  const auto written = (*table)->commit();
  EXPECT_TRUE(written.ok() && written->empty());
  return text;
}

inline std::vector<WrittenFile> write_table(TableFormat format, const std::filesystem::path& path,
                                            const std::vector<CoefficientRecord>& records) {
  auto table = create_table(format, path, VariantColumn::present);
  EXPECT_TRUE(table.ok());
  for (const auto& record : records) EXPECT_TRUE((*table)->append(record).ok());
  auto written = (*table)->commit();
  EXPECT_TRUE(written.ok());
  return *written;
}

}  // namespace shoal::test
