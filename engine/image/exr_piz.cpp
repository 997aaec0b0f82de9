#include "image/exr_piz.h"

#include <algorithm>
#include <bit>
#include <cstring>

namespace shoal {
namespace {

constexpr std::size_t kBitmapBytes = 65536 / 8;

std::size_t halves_of(SampleType type) { return sample_size(type) / sizeof(std::uint16_t); }

std::size_t bytes_of(const ExrChunkShape& shape) {
  std::size_t bytes = 0;
  for (const SampleType type : shape.channels) bytes += sample_size(type);
  return bytes * shape.width * shape.rows;
}

std::uint32_t read_unsigned(std::span<const std::byte> bytes) {
  std::uint32_t value = 0;
  for (std::size_t i = bytes.size(); i-- > 0;) {
    value = value << 8 | std::to_integer<std::uint32_t>(bytes[i]);
  }
  return value;
}

}  // namespace

Expansion PizExpander::expand(std::span<const std::byte> packed, const ExrChunkShape& shape,
                              std::span<std::byte> out) {
  const auto bitmap_bytes = read_values(packed);
  if (!bitmap_bytes || out.size() != bytes_of(shape)) return Expansion::damaged;
  packed = packed.subspan(*bitmap_bytes);
  if (packed.size() < 4) return Expansion::damaged;
  const std::size_t huffman_bytes = read_unsigned(packed.first(4));
  packed = packed.subspan(4);
  if (huffman_bytes > packed.size()) return Expansion::damaged;
  numbers_.resize_uninitialised(out.size() / sizeof(std::uint16_t));
  if (!huffman_.decode(packed.first(huffman_bytes), numbers_.span())) return Expansion::damaged;
  undo_wavelets(shape);
  place(shape, out.data());
  return Expansion::done;
}

// A bitmap of the values that occur, of which only the bytes from the first to the last that is not
// zero are there; 0 counts as occurring. Returns the bytes taken, or nothing if it is damaged.
std::optional<std::size_t> PizExpander::read_values(std::span<const std::byte> packed) {
  constexpr std::size_t kLeader = 4;
  if (packed.size() < kLeader) return std::nullopt;
  const std::size_t first = read_unsigned(packed.first(2));
  const std::size_t last = read_unsigned(packed.subspan(2, 2));
  if (last >= kBitmapBytes) return std::nullopt;
  const std::size_t size = first <= last ? last - first + 1 : 0;
  if (packed.size() - kLeader < size) return std::nullopt;

  values_[0] = 0;
  std::size_t count = 1;
  for (std::size_t i = 0; i < size; ++i) {
    auto bits = std::to_integer<unsigned>(packed[kLeader + i]);
    if (first + i == 0) bits &= ~1u;
    for (; bits != 0; bits &= bits - 1) {
      values_[count++] = static_cast<std::uint16_t>((first + i) * 8 +
                                                    static_cast<unsigned>(std::countr_zero(bits)));
    }
  }
  // Numbers that a damaged chunk makes up mean 0; most of the table does from the last chunk on.
  if (count <= greatest_) std::fill(&values_[count], &values_[greatest_] + 1, std::uint16_t{0});
  greatest_ = static_cast<std::uint16_t>(count - 1);
  return kLeader + size;
}

void PizExpander::undo_wavelets(const ExrChunkShape& shape) {
  std::uint16_t* plane = numbers_.data();
  for (const SampleType type : shape.channels) {
    codecs_.undo_exr_wavelet(plane, shape.width, shape.rows, halves_of(type), greatest_);
    plane += shape.width * shape.rows * halves_of(type);
  }
}

void PizExpander::place(const ExrChunkShape& shape, std::byte* out) const {
  for (std::size_t row = 0; row < shape.rows; ++row) {
    const std::uint16_t* plane = numbers_.data();
    for (const SampleType type : shape.channels) {
      const std::size_t size = shape.width * halves_of(type);
      const std::uint16_t* from = plane + row * size;
      for (std::size_t i = 0; i < size; ++i) {
        std::memcpy(out + i * sizeof(std::uint16_t), &values_[from[i]], sizeof(std::uint16_t));
      }
      out += size * sizeof(std::uint16_t);
      plane += size * shape.rows;
    }
  }
}

}  // namespace shoal
