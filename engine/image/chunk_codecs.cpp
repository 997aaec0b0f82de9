#include "image/chunk_codecs.h"

#include <cstdint>
#include <cstring>

#include "image/exr_wavelet.h"

namespace shoal {
namespace {

template <typename Sample>
void sum_planes_of(const std::byte* planes, std::size_t plane_count, std::size_t count,
                   std::byte* out) {
  Sample sum = 0;
  for (std::size_t i = 0; i < count; ++i, out += sizeof sum) {
    for (std::size_t plane = 0; plane < plane_count; ++plane) {
      const auto byte = std::to_integer<std::uint32_t>(planes[plane * count + i]);
      sum = static_cast<Sample>(sum + (byte << (8 * (sizeof sum - 1 - plane))));
    }
    std::memcpy(out, &sum, sizeof sum);
  }
}

void undo_predictor_and_split(std::byte* in, std::size_t size, std::byte* out) {
  if (size == 0) return;
  auto previous = std::to_integer<std::uint8_t>(in[0]);
  for (std::size_t i = 1; i < size; ++i) {
    previous = static_cast<std::uint8_t>(previous + std::to_integer<std::uint8_t>(in[i]) - 128);
    in[i] = std::byte{previous};
  }
  const std::byte* odd = in + (size + 1) / 2;
  for (std::size_t i = 0; i < size; ++i) out[i] = i % 2 == 0 ? in[i / 2] : odd[i / 2];
}

}  // namespace

void sum_exr_planes(const std::byte* planes, std::size_t plane_count, std::size_t count,
                    std::byte* out) {
  if (plane_count == 2) return sum_planes_of<std::uint16_t>(planes, plane_count, count, out);
  sum_planes_of<std::uint32_t>(planes, plane_count, count, out);
}

ChunkCodecs portable_chunk_codecs() {
  return {&undo_predictor_and_split, &undo_exr_wavelet, &sum_exr_planes};
}

}  // namespace shoal
