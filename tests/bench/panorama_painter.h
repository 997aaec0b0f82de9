// Pictures to measure with: textured as photographs are, so that they compress as photographs do,
// in any size, painted row by row.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

namespace shoal::bench {

// Smooth noise of one scale: random values on a lattice that closes around the picture, blended
// between.
class NoiseOctave {
 public:
  NoiseOctave(int width, int height, int columns, float amplitude, std::uint64_t seed);

  // Adds a row of noise, `width` values within +-amplitude. Cheapest when rows ascend.
  void add_row(int row, float* sums);

 private:
  void fill_lattice_row(int index, std::vector<float>& values) const;

  double lattice_rows_per_row_;
  float amplitude_;
  std::uint64_t seed_;
  std::vector<int> cells_;      // (width): the lattice column to the left of a pixel
  std::vector<float> weights_;  // (width): how much the column to the right counts
  int upper_index_ = -2;        // the lattice row that upper_ holds
  std::vector<float> upper_;    // (columns + 1), the last like the first
  std::vector<float> lower_;
  std::vector<float> blended_;
};

// Linear RGB of an outdoor panorama: a sky-like gradient with soft clouds over rougher ground,
// noise from the size of the picture down to two texels, a film-like grain of about 1 %, and a sun
// of half a degree and 5e4 over all else. The same size and seed give the same picture.
class PanoramaPainter {
 public:
  // 8 <= width, 4 <= height.
  PanoramaPainter(int width, int height, std::uint64_t seed);

  // Paints row `row` into three planes of `width` samples. Cheapest when rows ascend.
  void paint_row(int row, const std::array<float*, 3>& planes);

 private:
  void paint_texture(int row);
  void add_grain(int row, const std::array<float*, 3>& planes) const;
  void add_sun(int row, const std::array<float*, 3>& planes) const;

  int width_;
  int height_;
  std::uint64_t seed_;
  std::vector<NoiseOctave> broad_octaves_;
  std::vector<NoiseOctave> fine_octaves_;
  std::vector<NoiseOctave> hue_octaves_;
  std::vector<float> broad_;  // (width) each: sums of the row at hand
  std::vector<float> fine_;
  std::vector<float> hue_;
};

}  // namespace shoal::bench
