#include "image/chunk_codecs.h"

#include <cstdint>

namespace shoal {
namespace {

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

ChunkCodecs portable_chunk_codecs() { return {&undo_predictor_and_split}; }

}  // namespace shoal
