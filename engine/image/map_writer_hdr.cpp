// Radiance .hdr maps, in new RLE where the width allows it and flat elsewhere.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "image/map_formats.h"

namespace shoal {
namespace {

constexpr int kMinRun = 4;  // shorter runs cost as much as the literals that they break up
constexpr int kMaxRun = 127;
constexpr int kMaxLiteral = 128;

// How many equal bytes start at `begin`, up to kMaxRun.
int run_length(const std::string& plane, int begin) {
  const int end = std::min(static_cast<int>(plane.size()), begin + kMaxRun);
  int at = begin + 1;
  while (at < end && plane[at] == plane[begin]) ++at;
  return at - begin;
}

void append_new_rle(const std::string& plane, std::string& out) {
  const int width = static_cast<int>(plane.size());
  for (int at = 0; at < width;) {
    int literal_end = at;
    int run = 0;
    while (literal_end < width && literal_end - at < kMaxLiteral) {
      run = run_length(plane, literal_end);
      if (run >= kMinRun) break;
      literal_end = std::min(literal_end + run, at + kMaxLiteral);
      run = 0;
    }
    if (literal_end > at) {
      out.push_back(static_cast<char>(literal_end - at));
      out.append(plane, at, literal_end - at);
    }
    if (run >= kMinRun) {
      out.push_back(static_cast<char>(128 + run));
      out.push_back(plane[literal_end]);
      literal_end += run;
    }
    at = literal_end;
  }
}

class HdrMapWriter final : public MapWriter {
 public:
  HdrMapWriter(const std::filesystem::path& path, const MapFile& map, AtomicFile file)
      : MapWriter(path, map), file_(std::move(file)) {
    for (auto& plane : texels_) plane.resize(width_);
  }

  Status write_header(const MapFile& map) {
    std::string header = "#?RADIANCE\n";
    for (const auto& [name, text] : map.attributes) header += fmt::format("# {}: {}\n", name, text);
    header += "FORMAT=32-bit_rle_rgbe\n\n";
    header += fmt::format("-Y {} +X {}\n", height_, width_);
    return file_.write(header);
  }

 private:
  Status encode_rows(const std::array<const float*, 3>& planes, std::ptrdiff_t stride,
                     int row_count) override {
    std::string bytes;
    for (int row = 0; row < row_count; ++row) {
      const auto offset = row * stride;
      for (int x = 0; x < width_; ++x) {
        const auto texel =
            encode_rgbe(planes[0][offset + x], planes[1][offset + x], planes[2][offset + x]);
        for (int c = 0; c < 4; ++c) texels_[c][x] = static_cast<char>(texel[c]);
      }
      append_row(bytes);
    }
    return file_.write(bytes);
  }

  // A flat row cannot be mistaken for another encoding: the largest mantissa of a texel that is not
  // black is at least 128, so no texel starts with 1, 1, 1 or 2, 2.
  void append_row(std::string& bytes) const {
    if (width_ >= 8 && width_ <= 32767) {
      for (const int byte : {2, 2, width_ >> 8, width_ & 255}) {
        bytes.push_back(static_cast<char>(byte));
      }
      for (const auto& plane : texels_) append_new_rle(plane, bytes);
    } else {
      for (int x = 0; x < width_; ++x) {
        for (const auto& plane : texels_) bytes.push_back(plane[x]);
      }
    }
  }

  Status finish() override { return file_.commit(); }

  AtomicFile file_;
  std::array<std::string, 4> texels_;  // of one row
};

float light(float value) { return value > 0.0f ? value : 0.0f; }  // NaN compares false

}  // namespace

std::array<unsigned char, 4> encode_rgbe(float red, float green, float blue) {
  constexpr double kBrightest = 255.0 / 256.0 * 0x1p127;
  std::array<double, 3> colour{};
  const std::array<float, 3> given = {red, green, blue};
  for (int c = 0; c < 3; ++c) colour[c] = std::min<double>(light(given[c]), kBrightest);
  const double largest = *std::max_element(colour.begin(), colour.end());
  int exponent = 0;
  std::frexp(largest, &exponent);  // largest < 2^exponent
  if (std::round(std::ldexp(largest, 8 - exponent)) > 255.0) ++exponent;
  if (largest == 0.0 || exponent + 128 < 1) return {0, 0, 0, 0};
  std::array<unsigned char, 4> texel{};
  for (int c = 0; c < 3; ++c) {
    texel[c] = static_cast<unsigned char>(std::round(std::ldexp(colour[c], 8 - exponent)));
  }
  texel[3] = static_cast<unsigned char>(exponent + 128);
  return texel;
}

MapWriterResult create_hdr_map(const std::filesystem::path& path, const MapFile& map) {
  SHOAL_ASSIGN_OR_RETURN(file, AtomicFile::create(path));
  auto writer = std::make_unique<HdrMapWriter>(path, map, std::move(file));
  SHOAL_RETURN_IF_ERROR(writer->write_header(map));
  return std::unique_ptr<MapWriter>(std::move(writer));
}

}  // namespace shoal
