// A row band: consecutive scanlines of a picture, planar, in the file's own sample type.
//
// It is what flows from the readers (image/) to the kernels (kernels/). A band owns nothing; its
// planes point into buffers of the reader that made it and live until that reader's next read.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

namespace shoal {

// How one sample lies in memory, native byte order, no alignment beyond one byte promised.
enum class SampleType : std::uint8_t {
  half,         // IEEE 754 binary16
  float32,      // IEEE 754 binary32
  uint32,       // the number itself, not a fraction of the maximum
  rgbe_floor,   // an 8-bit mantissa m that needs the band's exponent plane: m/256 * 2^(e-128)
  rgbe_center,  // the same with m + 1/2 for m; both: e = 0 is black
};

[[nodiscard]] constexpr std::size_t sample_size(SampleType type) {
  switch (type) {
    case SampleType::half:
      return 2;
    case SampleType::rgbe_floor:
    case SampleType::rgbe_center:
      return 1;
    default:
      return 4;
  }
}

struct Plane {
  const std::byte* data = nullptr;  // first sample of the first row
  std::ptrdiff_t row_stride = 0;    // bytes from a row to the next; 0 repeats one row, may be < 0
  SampleType type = SampleType::float32;

  [[nodiscard]] const std::byte* row(int index) const { return data + index * row_stride; }
};

inline constexpr int kMaxChannels = 3;

struct RowBand {
  int row_begin = 0;  // rows [row_begin, row_end) of the picture, top row 0
  int row_end = 0;
  int width = 0;          // samples a row
  int channel_count = 3;  // 3: R, G, B (or X, Y, Z); 1: grey
  std::array<Plane, kMaxChannels> channels;
  Plane exponent;  // rgbe only: one byte a pixel

  [[nodiscard]] int row_count() const { return row_end - row_begin; }
};

}  // namespace shoal
