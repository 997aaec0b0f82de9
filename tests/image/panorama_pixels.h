// The pixels of a source, one by one and obviously, for comparison with what they should be.
#pragma once

#include <gtest/gtest.h>
#include <half.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <vector>

#include "image/panorama_source.h"

namespace shoal::test {

// Row-major in the picture as it is looked at. `values` are the file's own numbers, before
// to_linear_rec709; `texels` are the bytes R, G, B, E of an RGBE picture.
struct PanoramaPixels {
  int width = 0, height = 0, channel_count = 0;
  std::vector<float> values;                        // pixel by pixel, channel_count each
  std::vector<std::array<std::uint8_t, 4>> texels;  // RGBE only

  bool operator==(const PanoramaPixels&) const = default;
};

template <typename T>
T load_as(const std::byte* from) {
  T value;
  std::memcpy(&value, from, sizeof value);
  return value;
}

inline float sample_value(const Plane& plane, const Plane& exponent, int row, int i) {
  const std::byte* at = plane.row(row) + i * static_cast<std::ptrdiff_t>(sample_size(plane.type));
  switch (plane.type) {
    case SampleType::half:
      return load_as<half>(at);
    case SampleType::float32:
      return load_as<float>(at);
    case SampleType::uint32:
      return static_cast<float>(load_as<std::uint32_t>(at));
    default:
      break;
  }
  const int e = std::to_integer<int>(exponent.row(row)[i]);
  const double bias = plane.type == SampleType::rgbe_center ? 0.5 : 0.0;
  return e == 0 ? 0.0f : static_cast<float>(std::ldexp(std::to_integer<int>(*at) + bias, e - 136));
}

// Reads all bands in order. Fails the test when bands overlap, leave gaps or reach outside.
inline Result<PanoramaPixels> read_all(const PanoramaSource& source) {
  const auto& info = source.info();
  const bool by_rows = info.scan_axis == ScanAxis::rows;
  PanoramaPixels pixels{info.width, info.height, info.channel_count, {}, {}};
  const auto count = static_cast<std::size_t>(info.width) * info.height;
  pixels.values.resize(count * info.channel_count);
  std::vector<int> seen(by_rows ? info.height : info.width, 0);
  SHOAL_ASSIGN_OR_RETURN(reader, source.new_reader());
  for (int index = 0; index < info.band_count; ++index) {
    SHOAL_ASSIGN_OR_RETURN(band, reader->read(index));
    EXPECT_EQ(band.width, by_rows ? info.width : info.height);
    EXPECT_EQ(band.channel_count, info.channel_count);
    for (int row = 0; row < band.row_count(); ++row) {
      const int line = band.row_begin + row;
      seen.at(line) += 1;
      for (int i = 0; i < band.width; ++i) {
        const int at = info.samples_reversed ? band.width - 1 - i : i;
        const std::size_t pixel = by_rows ? static_cast<std::size_t>(line) * info.width + at
                                          : static_cast<std::size_t>(at) * info.width + line;
        for (int c = 0; c < info.channel_count; ++c) {
          pixels.values[pixel * info.channel_count + c] =
              sample_value(band.channels[c], band.exponent, row, i);
        }
        if (!band.exponent.data) continue;
        pixels.texels.resize(count);
        for (int c = 0; c < 3; ++c) {
          pixels.texels[pixel][c] = std::to_integer<std::uint8_t>(band.channels[c].row(row)[i]);
        }
        pixels.texels[pixel][3] = std::to_integer<std::uint8_t>(band.exponent.row(row)[i]);
      }
    }
  }
  EXPECT_EQ(seen, std::vector<int>(seen.size(), 1)) << "each scanline in exactly one band";
  return pixels;
}

inline Result<PanoramaPixels> read_all(const Result<std::unique_ptr<PanoramaSource>>& source) {
  if (!source) return source.error();
  return read_all(**source);
}

}  // namespace shoal::test
