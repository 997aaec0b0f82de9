#include "kernels/wavelet.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "support/every_target.h"
#include "support/random_numbers.h"

namespace shoal::kernels {
namespace {

struct Picture {
  std::size_t width;
  std::size_t height;
  std::size_t interleaved;
  std::vector<std::uint16_t> samples;

  Picture(std::size_t width_in, std::size_t height_in, std::size_t interleaved_in)
      : width(width_in),
        height(height_in),
        interleaved(interleaved_in),
        samples(width_in * height_in * interleaved_in) {}
  std::uint16_t& at(std::size_t plane, std::size_t x, std::size_t y) {
    return samples[(y * width + x) * interleaved + plane];
  }
};

// The means and differences that the wavelet is made of, as they are defined.
void transform(std::uint16_t& a, std::uint16_t& b, bool is_14_bits) {
  if (is_14_bits) {
    const int first = static_cast<std::int16_t>(a);
    const int second = static_cast<std::int16_t>(b);
    a = static_cast<std::uint16_t>((first + second) >> 1);
    b = static_cast<std::uint16_t>(first - second);
    return;
  }
  const int first = (a + 0x8000) & 0xffff;
  const int difference = first - b;
  const int mean = (first + b) / 2 + (difference < 0 ? 0x8000 : 0);
  a = static_cast<std::uint16_t>(mean);
  b = static_cast<std::uint16_t>(difference);
}

// From the finest level: pairs side by side, then pairs one above the other, of the samples whose
// column and row are multiples of `step`; one without a partner stays. A column or row counts at a
// level if `step` of them begin with it.
void transform(Picture& picture, std::uint16_t greatest) {
  const bool is_14_bits = greatest < 1 << 14;
  for (std::size_t step = 1; 2 * step <= std::min(picture.width, picture.height); step *= 2) {
    const std::size_t columns = picture.width / step;
    const std::size_t rows = picture.height / step;
    for (std::size_t plane = 0; plane < picture.interleaved; ++plane) {
      for (std::size_t y = 0; y < rows; ++y) {
        for (std::size_t x = 0; x + 1 < columns; x += 2) {
          transform(picture.at(plane, x * step, y * step),
                    picture.at(plane, (x + 1) * step, y * step), is_14_bits);
        }
      }
      for (std::size_t y = 0; y + 1 < rows; y += 2) {
        for (std::size_t x = 0; x < columns; ++x) {
          transform(picture.at(plane, x * step, y * step),
                    picture.at(plane, x * step, (y + 1) * step), is_14_bits);
        }
      }
    }
  }
}

// The 14-bit wavelet has an inverse on 14 bits, the other one on 16.
TEST(Wavelet, IsUndoneForEverySizeOnEveryTarget) {
  std::vector<std::pair<std::size_t, std::size_t>> sizes;
  for (std::size_t width = 1; width <= 70; ++width) {
    for (const std::size_t height : {1, 2, 3, 5, 7, 16, 31, 32}) sizes.emplace_back(width, height);
  }
  for (std::size_t height = 1; height <= 70; ++height) sizes.emplace_back(45, height);
  sizes.insert(sizes.end(), {{1023, 32}, {1024, 32}, {4099, 17}});
  test::RandomNumbers random(7);
  for (const auto& [width, height] : sizes) {
    for (const std::size_t interleaved : {1, 2}) {
      for (const std::uint16_t greatest : {0, 1, 0x3fff, 0x4000, 0xffff}) {
        Picture picture(width, height, interleaved);
        for (std::uint16_t& sample : picture.samples) {
          sample = static_cast<std::uint16_t>(random.bits() % (greatest + 1u));
        }
        Picture transformed = picture;
        transform(transformed, greatest);
        test::for_every_target([&] {
          Picture undone = transformed;
          undo_wavelet(undone.samples.data(), width, height, interleaved, greatest);
          EXPECT_TRUE(undone.samples == picture.samples)
              << width << " x " << height << " x " << interleaved << " up to " << greatest;
        });
      }
    }
  }
}

// Samples that no wavelet makes, as in a damaged file, overflow alike on every target.
TEST(Wavelet, OfAnySamplesIsTheSameOnEveryTarget) {
  test::RandomNumbers random(8);
  for (const std::size_t interleaved : {1, 2}) {
    for (const std::uint16_t greatest : {0x3fff, 0x4000}) {
      Picture picture(203, 33, interleaved);
      for (std::uint16_t& sample : picture.samples) {
        sample = static_cast<std::uint16_t>(random.bits());
      }
      std::vector<std::uint16_t> first;
      test::for_every_target([&] {
        Picture undone = picture;
        undo_wavelet(undone.samples.data(), 203, 33, interleaved, greatest);
        if (first.empty()) first = undone.samples;
        EXPECT_TRUE(undone.samples == first);
      });
    }
  }
}

}  // namespace
}  // namespace shoal::kernels
