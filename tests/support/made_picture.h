// Panoramas that a test makes itself: planar floats, written through the product's own map writers.
#pragma once

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <filesystem>
#include <functional>
#include <vector>

#include "image/map_writer.h"
#include "support/random_numbers.h"

namespace shoal::test {

struct Picture {
  int width = 0;
  int height = 0;
  std::array<std::vector<float>, 3> planes;  // each (height, width)

  Picture(int width_in, int height_in) : width(width_in), height(height_in) {
    for (auto& plane : planes) plane.resize(static_cast<std::size_t>(width) * height);
  }
  [[nodiscard]] float& at(int channel, int row, int column) {
    return planes[channel][static_cast<std::size_t>(row) * width + column];
  }
  [[nodiscard]] float at(int channel, int row, int column) const {
    return planes[channel][static_cast<std::size_t>(row) * width + column];
  }
};

// A picture from a function of (channel, row, column).
inline Picture make_picture(int width, int height,
                            const std::function<double(int, int, int)>& sample) {
  Picture picture(width, height);
  for (int c = 0; c < 3; ++c) {
    for (int i = 0; i < height; ++i) {
      for (int j = 0; j < width; ++j) picture.at(c, i, j) = static_cast<float>(sample(c, i, j));
    }
  }
  return picture;
}

// Light over four orders of magnitude, with a sun of 10^5 in one pixel.
inline Picture make_noisy_picture(int width, int height, std::uint64_t seed) {
  RandomNumbers random(seed);
  Picture picture = make_picture(
      width, height, [&](int, int, int) { return std::exp(random.between(-5.0, 4.0)); });
  for (int c = 0; c < 3; ++c) picture.at(c, height / 3, width / 5) = 1e5F;
  return picture;
}

inline void write_picture(const Picture& picture, MapFormat format,
                          const std::filesystem::path& path) {
  MapFile file;
  file.format = format;
  file.width = picture.width;
  file.height = picture.height;
  auto writer = MapWriter::create(path, file);
  ASSERT_TRUE(writer) << writer.error().text();
  const Status rows = (*writer)->write_rows(
      {picture.planes[0].data(), picture.planes[1].data(), picture.planes[2].data()}, picture.width,
      picture.height);
  ASSERT_TRUE(rows) << rows.error().text();
  const Status committed = (*writer)->commit();
  ASSERT_TRUE(committed) << committed.error().text();
}

}  // namespace shoal::test
