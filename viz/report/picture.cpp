#include "report/picture.h"

#include <libdeflate.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <memory>

#include "library/light.h"

namespace shoal::viz {
namespace {

constexpr int kExponentBias = 128;
constexpr int kCompressionLevel = 9;  // 25 ms for a noisy 512x256
constexpr float kLargest = 1e38F;     // RGBE ends at 255 * 2^119

float representable(float value) {
  return value > 0.0F ? std::min(value, kLargest) : 0.0F;  // NaN is not greater
}

// One texel's mantissas and exponent.
std::array<std::uint8_t, 4> rgbe_of(const float* rgb) {
  const std::array<float, 3> value = {representable(rgb[0]), representable(rgb[1]),
                                      representable(rgb[2])};
  const float largest = *std::max_element(value.begin(), value.end());
  int exponent = 0;
  std::frexp(largest, &exponent);
  if (largest == 0.0F || exponent + kExponentBias < 1) return {0, 0, 0, 0};
  std::array<std::uint8_t, 4> rgbe{};
  for (int c = 0; c < 3; ++c) {
    const long mantissa = std::lround(std::ldexp(double{value[c]}, 8 - exponent));
    rgbe[c] = static_cast<std::uint8_t>(std::min(mantissa, 255L));
  }
  rgbe[3] = static_cast<std::uint8_t>(exponent + kExponentBias);
  return rgbe;
}

std::string zlib_compressed(std::string_view bytes) {
  const std::unique_ptr<libdeflate_compressor, void (*)(libdeflate_compressor*)> compressor(
      libdeflate_alloc_compressor(kCompressionLevel), libdeflate_free_compressor);
  std::string out(libdeflate_zlib_compress_bound(compressor.get(), bytes.size()), '\0');
  out.resize(libdeflate_zlib_compress(compressor.get(), bytes.data(), bytes.size(), out.data(),
                                      out.size()));
  return out;
}

void append_big_endian(std::string& out, std::uint32_t value) {
  for (const int shift : {24, 16, 8, 0}) out += static_cast<char>(value >> shift & 255u);
}

// Length, type, data, and the checksum of the last two (PNG specification, section 5.3).
void append_chunk(std::string& out, std::string_view type, std::string_view data) {
  append_big_endian(out, static_cast<std::uint32_t>(data.size()));
  const std::size_t begin = out.size();
  out += type;
  out += data;
  append_big_endian(out, libdeflate_crc32(0, out.data() + begin, out.size() - begin));
}

char srgb_byte(double linear) {
  return static_cast<char>(static_cast<unsigned char>(std::lround(255.0 * srgb_encoded(linear))));
}

// Rows of filter type 1, each byte less the one a texel to its left.
std::string filtered_rows(const Pixels& pixels, double exposure) {
  std::string rows;
  for (int row = 0; row < pixels.height; ++row) {
    rows += '\1';
    std::array<char, 3> left{};
    for (int column = 0; column < pixels.width; ++column) {
      for (int c = 0; c < 3; ++c) {
        const char byte = srgb_byte(exposure * pixels.at(row, column)[c]);
        rows += static_cast<char>(byte - left[c]);
        left[c] = byte;
      }
    }
  }
  return rows;
}

}  // namespace

std::string rgbe_planes(const Pixels& pixels) {
  const std::size_t count = static_cast<std::size_t>(pixels.width) * pixels.height;
  std::string planes(4 * count, '\0');
  for (std::size_t i = 0; i < count; ++i) {
    const std::array<std::uint8_t, 4> rgbe = rgbe_of(pixels.rgb.data() + 3 * i);
    for (int plane = 0; plane < 4; ++plane) {
      planes[plane * count + i] = static_cast<char>(rgbe[plane]);
    }
  }
  return planes;
}

std::string compressed_planes(std::string_view bytes, int width) {
  std::string differences(bytes);
  for (std::size_t i = bytes.size(); i-- > 0;) {
    const std::size_t step = i % width == 0 ? static_cast<std::size_t>(width) : 1;
    if (i >= step) differences[i] = static_cast<char>(bytes[i] - bytes[i - step]);
  }
  return zlib_compressed(differences);
}

Pixels shrunk(const Pixels& pixels, int width) {
  Pixels out;
  out.width = width;
  out.height = width / 2;
  for (int row = 0; row < out.height; ++row) {
    const int top = row * pixels.height / out.height;
    const int bottom = std::max(top + 1, (row + 1) * pixels.height / out.height);
    for (int column = 0; column < out.width; ++column) {
      const int left = column * pixels.width / out.width;
      const int right = std::max(left + 1, (column + 1) * pixels.width / out.width);
      std::array<double, 3> sum{};
      for (int y = top; y < bottom; ++y) {
        for (int x = left; x < right; ++x) {
          for (int c = 0; c < 3; ++c) sum[c] += pixels.at(y, x)[c];
        }
      }
      const double count = double(bottom - top) * (right - left);
      for (const double total : sum) out.rgb.push_back(static_cast<float>(total / count));
    }
  }
  return out;
}

std::string srgb_png(const Pixels& pixels, double exposure) {
  std::string header;
  append_big_endian(header, static_cast<std::uint32_t>(pixels.width));
  append_big_endian(header, static_cast<std::uint32_t>(pixels.height));
  header += std::string_view("\x08\x02\0\0\0", 5);  // 8 bits, RGB, deflate, filters, not interlaced
  std::string png = "\x89PNG\r\n\x1A\n";
  append_chunk(png, "IHDR", header);
  append_chunk(png, "tEXt", std::string("Software\0", 9) + std::string(kPngSoftware));
  append_chunk(png, "IDAT", zlib_compressed(filtered_rows(pixels, exposure)));
  append_chunk(png, "IEND", "");
  return png;
}

}  // namespace shoal::viz
