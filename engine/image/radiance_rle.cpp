#include "image/radiance_rle.h"

#include <algorithm>
#include <bit>
#include <cstring>

namespace shoal {
namespace {

constexpr int kMaxRun = 127;
constexpr int kBlock = 64;  // pixels that are looked at together for repeat marks

struct Input {
  const std::uint8_t* at;
  const std::uint8_t* end;

  [[nodiscard]] std::ptrdiff_t left() const { return end - at; }
};

constexpr ScanlineResult kCutShort{ScanlineState::cut_short, 0, ""};

ScanlineResult broken(const char* fault) { return {ScanlineState::broken, 0, fault}; }

ScanlineResult whole(std::span<const std::uint8_t> input, const Input& in) {
  return {ScanlineState::whole, static_cast<std::size_t>(in.at - input.data()), ""};
}

// Copies of a constant size become vector moves; most runs fit the first one. n <= 128, so at most
// kRadianceSlack bytes too many are touched.
// (Runs and literals without a branch between them were tried: the longer chain of dependencies
// from one to the next costs more than the wrong guesses, by a fifth to a half.)
inline void copy_run(std::uint8_t* to, const std::uint8_t* from, std::ptrdiff_t n) {
  std::memcpy(to, from, 32);
  if (n <= 32) return;
  std::memcpy(to + 32, from + 32, 32);
  if (n <= 64) return;
  std::memcpy(to + 64, from + 64, 64);
}

inline void fill_run(std::uint8_t* to, std::uint8_t value, std::ptrdiff_t n) {
  std::memset(to, value, 32);
  if (n <= 32) return;
  std::memset(to + 32, value, 32);
  if (n <= 64) return;
  std::memset(to + 64, value, 64);
}

enum class Runs { expand, skip };

// One component of a scanline in the new encoding. Skipping reads nothing but the codes.
template <Runs kRuns>
ScanlineResult take_component(Input& in, std::uint8_t* out, int width) {
  std::ptrdiff_t left = width;
  const std::uint8_t* at = in.at;
  while (left > 0) {
    if (in.end - at < 2) return kCutShort;
    const int code = at[0];
    const bool is_run = code > 128;
    const std::ptrdiff_t n = is_run ? code - 128 : code;
    if (n == 0) return broken("has a run of no pixels");
    if (n > left) return broken("has a run that goes beyond its end");
    if (!is_run && in.end - at < 1 + n) return kCutShort;
    if constexpr (kRuns == Runs::expand) {
      if (is_run) {
        fill_run(out, at[1], n);
      } else {
        copy_run(out, at + 1, n);
      }
      out += n;
    }
    at += is_run ? 2 : 1 + n;
    left -= n;
  }
  in.at = at;
  return {};
}

// The bytes of a pixel that make it a repeat mark: (pixel & mask) == (1, 1, 1, 1) & mask.
using Pixel = std::uint32_t;
constexpr Pixel kOnes = 0x01010101;

Pixel mark_mask(DataSize data_size) {
  constexpr Pixel kColour = std::endian::native == std::endian::little ? 0x00ffffffu : 0xffffff00u;
  return data_size == DataSize::of_flat ? 0xffffffffu : kColour;
}

bool is_repeat_mark(const std::uint8_t* at, Pixel mask) {
  Pixel pixel;
  std::memcpy(&pixel, at, sizeof pixel);
  return ((pixel ^ kOnes) & mask) == 0;
}

// Without an early exit, so that the compiler makes vectors of it.
bool holds_repeat_mark(const std::uint8_t* pixels, int count, Pixel mask) {
  Pixel found = 0;
  for (int i = 0; i < count; ++i) found |= is_repeat_mark(pixels + 4 * i, mask) ? 1u : 0u;
  return found != 0;
}

void split_pixels(const std::uint8_t* __restrict pixels, int count, std::uint8_t* __restrict r,
                  std::uint8_t* __restrict g, std::uint8_t* __restrict b,
                  std::uint8_t* __restrict e) {
  for (int i = 0; i < count; ++i) {
    r[i] = pixels[4 * i];
    g[i] = pixels[4 * i + 1];
    b[i] = pixels[4 * i + 2];
    e[i] = pixels[4 * i + 3];
  }
}

// Old RLE and flat.
class PixelExpander {
 public:
  PixelExpander(Input& in, int width, DataSize data_size,
                const std::array<std::uint8_t*, 4>& planes)
      : in_(in), width_(width), mark_mask_(mark_mask(data_size)), planes_(planes) {}

  ScanlineResult expand() {
    while (done_ < width_) {
      const int block =
          static_cast<int>(std::min<std::ptrdiff_t>({kBlock, width_ - done_, in_.left() / 4}));
      if (block == 0) return kCutShort;
      if (!holds_repeat_mark(in_.at, block, mark_mask_)) {
        take_pixels(block);
        continue;
      }
      for (int i = 0; i < block && done_ < width_; ++i) {
        if (!is_repeat_mark(in_.at, mark_mask_)) {
          take_pixels(1);
        } else if (auto result = take_repeat(); result.state != ScanlineState::whole) {
          return result;
        }
      }
    }
    return {};
  }

 private:
  void take_pixels(int count) {
    split_pixels(in_.at, count, planes_[0] + done_, planes_[1] + done_, planes_[2] + done_,
                 planes_[3] + done_);
    in_.at += 4 * static_cast<std::ptrdiff_t>(count);
    done_ += count;
    shift_ = 0;
  }

  ScanlineResult take_repeat() {
    if (done_ == 0) return broken("starts by repeating a pixel, before there is one");
    if (shift_ > 24) return broken("has more than four repeat marks behind each other");
    const std::int64_t count = std::int64_t{in_.at[3]} << shift_;
    if (count > width_ - done_) return broken("repeats a pixel beyond its end");
    for (std::uint8_t* plane : planes_) {
      std::memset(plane + done_, plane[done_ - 1], static_cast<std::size_t>(count));
    }
    in_.at += 4;
    done_ += static_cast<int>(count);
    shift_ += 8;
    return {};
  }

  Input& in_;
  int width_;
  Pixel mark_mask_;
  std::array<std::uint8_t*, 4> planes_;
  int done_ = 0;
  int shift_ = 0;  // of the next repeat mark's count
};

template <Runs kRuns>
ScanlineResult take_scanline(std::span<const std::uint8_t> input, int width, DataSize data_size,
                             const std::array<std::uint8_t*, 4>& planes) {
  Input in{input.data(), input.data() + input.size()};
  if (in.left() < 4) return kCutShort;
  const bool looks_new = allows_new_rle(width) && in.at[0] == 2 && in.at[1] == 2 && in.at[2] < 128;
  const bool is_new = looks_new && (in.at[2] << 8 | in.at[3]) == width;
  if (looks_new && !is_new && data_size != DataSize::of_flat) {
    return broken("states another width than the header");
  }
  if (!is_new) {
    const std::ptrdiff_t flat_bytes = 4 * static_cast<std::ptrdiff_t>(width);
    if (kRuns == Runs::skip && data_size == DataSize::of_flat && in.left() >= flat_bytes) {
      return {ScanlineState::whole, static_cast<std::size_t>(flat_bytes), ""};
    }
    auto result = PixelExpander(in, width, data_size, planes).expand();
    return result.state == ScanlineState::whole ? whole(input, in) : result;
  }
  in.at += 4;
  for (std::uint8_t* plane : planes) {
    auto result = take_component<kRuns>(in, plane, width);
    if (result.state != ScanlineState::whole) return result;
  }
  return whole(input, in);
}

}  // namespace

ScanlineResult expand_radiance_scanline(std::span<const std::uint8_t> input, int width,
                                        DataSize data_size,
                                        const std::array<std::uint8_t*, 4>& planes) {
  return take_scanline<Runs::expand>(input, width, data_size, planes);
}

ScanlineResult skip_radiance_scanline(std::span<const std::uint8_t> input, int width,
                                      DataSize data_size,
                                      const std::array<std::uint8_t*, 4>& planes) {
  return take_scanline<Runs::skip>(input, width, data_size, planes);
}

std::uint64_t smallest_radiance_scanline(int width) {
  // One pixel, then repeats: k marks behind each other cover at most 256^k - 1 pixels.
  std::uint64_t old_rle = 4;
  for (std::int64_t left = width - 1; left > 0; left >>= 8) old_rle += 4;
  if (!allows_new_rle(width)) return old_rle;
  const auto runs = static_cast<std::uint64_t>((width + kMaxRun - 1) / kMaxRun);
  return std::min<std::uint64_t>(old_rle, 4 + 4 * 2 * runs);
}

}  // namespace shoal
