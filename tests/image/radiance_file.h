// Radiance files of every kind, written by the tests themselves, one byte after another.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

#include "support/random_numbers.h"

namespace shoal::test {

using Texel = std::array<std::uint8_t, 4>;  // R, G, B, E
using Scanline = std::vector<Texel>;

enum class RowCoding { flat, old_rle, new_rle };

inline std::string flat_row(const Scanline& row) {
  std::string bytes;
  for (const Texel& texel : row) bytes.append(texel.begin(), texel.end());
  return bytes;
}

// Repeats as one mark a base-256 digit, lowest first, zero digits included.
inline std::string old_rle_row(const Scanline& row) {
  std::string bytes;
  for (std::size_t i = 0; i < row.size();) {
    std::size_t end = i + 1;
    while (end < row.size() && row[end] == row[i]) ++end;
    bytes.append(row[i].begin(), row[i].end());
    for (std::size_t repeats = end - i - 1; repeats > 0; repeats >>= 8) {
      bytes.append("\1\1\1");
      bytes.push_back(static_cast<char>(repeats & 255));
    }
    i = end;
  }
  return bytes;
}

// Runs of two and more as runs, everything else as literals.
inline std::string new_rle_row(const Scanline& row) {
  std::string bytes = {2, 2, static_cast<char>(row.size() >> 8),
                       static_cast<char>(row.size() & 255)};
  for (int c = 0; c < 4; ++c) {
    std::string literal;
    const auto flush = [&] {
      if (!literal.empty()) bytes.push_back(static_cast<char>(literal.size()));
      bytes += literal;
      literal.clear();
    };
    for (std::size_t i = 0; i < row.size();) {
      std::size_t end = i + 1;
      while (end < row.size() && end - i < 127 && row[end][c] == row[i][c]) ++end;
      if (end - i > 1) {
        flush();
        bytes.push_back(static_cast<char>(128 + (end - i)));
        bytes.push_back(static_cast<char>(row[i][c]));
      } else {
        literal.push_back(static_cast<char>(row[i][c]));
        if (literal.size() == 128) flush();
      }
      i = end;
    }
    flush();
  }
  return bytes;
}

inline std::string coded_row(const Scanline& row, RowCoding coding) {
  switch (coding) {
    case RowCoding::flat:
      return flat_row(row);
    case RowCoding::old_rle:
      return old_rle_row(row);
    default:
      return new_rle_row(row);
  }
}

// Whether new RLE exists for rows of this width.
inline bool allows_new_rle(int width) { return width >= 8 && width <= 32767; }

inline std::string radiance_header(const std::string& resolution, const std::string& lines = "",
                                   const std::string& format = "32-bit_rle_rgbe") {
  return "#?RADIANCE\n" + lines + "FORMAT=" + format + "\n\n" + resolution + "\n";
}

inline std::string usual_resolution(int width, int height) {
  return "-Y " + std::to_string(height) + " +X " + std::to_string(width);
}

// A texel whose largest mantissa is at least 128, as every writer makes them; or black.
inline Texel random_texel(RandomNumbers& random) {
  if (random.below(8) == 0) return {0, 0, 0, 0};
  Texel texel;
  for (auto& byte : texel) byte = static_cast<std::uint8_t>(random.below(256));
  texel[random.below(3)] |= 128;
  texel[3] = static_cast<std::uint8_t>(1 + random.below(255));
  return texel;
}

// Texels of which about half repeat their predecessor, some for very long.
inline Scanline random_scanline(RandomNumbers& random, int width) {
  Scanline row;
  while (static_cast<int>(row.size()) < width) {
    const Texel texel = random_texel(random);
    const int longest = random.below(10) == 0 ? 700 : 4;
    const int wanted = 1 + random.below(longest);
    const int count = std::min(wanted, width - static_cast<int>(row.size()));
    row.insert(row.end(), count, texel);
  }
  return row;
}

// (Truncating a file makes some file systems sync it; a new one is quicker.)
inline void write_bytes(const std::filesystem::path& path, const std::string& bytes) {
  std::filesystem::remove(path);
  std::ofstream(path, std::ios::binary) << bytes;
}

inline std::string read_bytes(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

}  // namespace shoal::test
