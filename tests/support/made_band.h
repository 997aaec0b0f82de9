// Row bands that a test makes itself, in every sample type, beside the values they stand for.
#pragma once

#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <vector>

#include "core/row_band.h"
#include "support/random_numbers.h"

namespace shoal::test {

// IEEE binary16 to double by its definition.
inline double half_value(std::uint16_t bits) {
  const int exponent = bits >> 10 & 31;
  const int mantissa = bits & 1023;
  const double magnitude =
      exponent == 0 ? std::ldexp(mantissa, -24) : std::ldexp(1024 + mantissa, exponent - 25);
  return bits >> 15 ? -magnitude : magnitude;
}

// A Radiance texel by its definition; e = 0 is black.
inline double rgbe_value(int mantissa, int exponent, SampleType type) {
  if (exponent == 0) return 0.0;
  const double offset = type == SampleType::rgbe_center ? 0.5 : 0.0;
  return std::ldexp(mantissa + offset, exponent - 136);
}

// A band of random samples with a guard byte before every plane, so that nothing is aligned.
struct MadeBand {
  RowBand band;
  std::vector<double> values;  // (channel_count, rows, width)
  std::vector<std::byte> storage;

  [[nodiscard]] double value(int channel, int row, int column) const {
    return values[(static_cast<std::size_t>(channel) * band.row_count() + row) * band.width +
                  column];
  }
};

inline double made_sample(SampleType type, RandomNumbers& random, std::byte* at, int exponent) {
  switch (type) {
    case SampleType::half: {
      // Positive, from denormals to 2^15.
      const auto bits = static_cast<std::uint16_t>(random.below(0x7800));
      std::memcpy(at, &bits, sizeof bits);
      return half_value(bits);
    }
    case SampleType::float32: {
      const auto value = static_cast<float>(std::exp(random.between(-9.0, 9.0)));
      std::memcpy(at, &value, sizeof value);
      return value;
    }
    case SampleType::uint32: {
      const auto value = static_cast<std::uint32_t>(random.bits());
      std::memcpy(at, &value, sizeof value);
      return static_cast<float>(value);
    }
    default: {
      const auto mantissa = static_cast<std::uint8_t>(random.bits());
      std::memcpy(at, &mantissa, sizeof mantissa);
      return rgbe_value(mantissa, exponent, type);
    }
  }
}

inline MadeBand make_band(SampleType type, int width, int rows, int channels, std::uint64_t seed) {
  RandomNumbers random(seed);
  MadeBand made;
  const std::size_t stride = width * sample_size(type) + 1;
  const std::size_t plane = stride * rows + 1;
  made.storage.resize((channels + 1) * plane);
  made.values.resize(static_cast<std::size_t>(channels) * rows * width);
  made.band = {0, rows, width, channels, {}, {}};
  std::byte* exponents = made.storage.data() + channels * plane + 1;
  for (int i = 0; i < rows * width; ++i) {
    // Now and then the exponents at the ends: black, denormal, largest.
    const int odd = random.below(40);
    const int exponent = odd == 0 ? 0 : odd == 1 ? 1 : 100 + random.below(50);
    exponents[i / width * stride + i % width] = static_cast<std::byte>(exponent);
  }
  made.band.exponent = {exponents, static_cast<std::ptrdiff_t>(stride), type};
  for (int c = 0; c < channels; ++c) {
    std::byte* data = made.storage.data() + c * plane + 1;
    made.band.channels[c] = {data, static_cast<std::ptrdiff_t>(stride), type};
    for (int i = 0; i < rows * width; ++i) {
      const std::size_t at = i / width * stride;
      made.values[static_cast<std::size_t>(c) * rows * width + i] =
          made_sample(type, random, data + at + i % width * sample_size(type),
                      static_cast<int>(exponents[at + i % width]));
    }
  }
  return made;
}

inline constexpr std::array kAllSampleTypes = {SampleType::half, SampleType::float32,
                                               SampleType::uint32, SampleType::rgbe_floor,
                                               SampleType::rgbe_center};

}  // namespace shoal::test
