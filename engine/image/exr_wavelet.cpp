#include "image/exr_wavelet.h"

#include <algorithm>

namespace shoal {
namespace {

struct Pair {
  std::uint16_t first;
  std::uint16_t second;
};

// Of a mean and a difference; kernels/wavelet.cpp says of what kind.
Pair undone_14_bits(std::uint16_t mean, std::uint16_t difference) {
  const auto d = static_cast<std::int16_t>(difference);
  const auto a = static_cast<std::uint16_t>(mean + (d & 1) + (d >> 1));
  return {a, static_cast<std::uint16_t>(a - difference)};
}

Pair undone_16_bits(std::uint16_t mean, std::uint16_t difference) {
  const auto b = static_cast<std::uint16_t>(mean - (difference >> 1));
  return {static_cast<std::uint16_t>(b + difference + 0x8000), b};
}

template <Pair (*undone)(std::uint16_t, std::uint16_t)>
class Plane {
 public:
  Plane(std::uint16_t* samples, std::size_t width, std::size_t height, std::size_t stride)
      : samples_(samples), width_(width), height_(height), stride_(stride) {}

  // At a level, every sample `distance` columns and rows from the next one counts, if as many lie
  // behind it; two and two are neighbours, and a last one may be without.
  void undo_level(std::size_t distance) {
    const std::size_t columns = width_ / distance * distance;
    const std::size_t rows = height_ / distance * distance;
    for (std::size_t y = 0; y + distance < rows; y += 2 * distance) {
      for (std::size_t x = 0; x < columns; x += distance) undo(at(x, y), at(x, y + distance));
    }
    for (std::size_t y = 0; y < rows; y += distance) {
      for (std::size_t x = 0; x + distance < columns; x += 2 * distance) {
        undo(at(x, y), at(x + distance, y));
      }
    }
  }

  // From the coarsest level, which is the last one of which the narrower side has two samples.
  void undo_all_levels() {
    std::size_t distance = 1;
    while (2 * distance <= std::min(width_, height_)) distance *= 2;
    while (distance > 1) {
      distance /= 2;
      undo_level(distance);
    }
  }

 private:
  std::uint16_t& at(std::size_t x, std::size_t y) { return samples_[(y * width_ + x) * stride_]; }
  static void undo(std::uint16_t& mean, std::uint16_t& difference) {
    const Pair pair = undone(mean, difference);
    mean = pair.first;
    difference = pair.second;
  }

  std::uint16_t* samples_;
  std::size_t width_;
  std::size_t height_;
  std::size_t stride_;
};

}  // namespace

void undo_exr_wavelet(std::uint16_t* samples, std::size_t width, std::size_t height,
                      std::size_t interleaved, std::uint16_t greatest) {
  for (std::size_t j = 0; j < interleaved; ++j) {
    if (greatest < 1 << 14) {
      Plane<undone_14_bits>(samples + j, width, height, interleaved).undo_all_levels();
    } else {
      Plane<undone_16_bits>(samples + j, width, height, interleaved).undo_all_levels();
    }
  }
}

}  // namespace shoal
