#include "image/exr_inflate.h"

#include <cstdint>
#include <cstring>

namespace shoal {

bool ExrInflater::can_expand(exr_compression_t compression) {
  return compression == EXR_COMPRESSION_NONE || compression == EXR_COMPRESSION_RLE ||
         compression == EXR_COMPRESSION_ZIPS || compression == EXR_COMPRESSION_ZIP;
}

ExrInflater::ExrInflater(exr_compression_t compression, const ChunkCodecs& codecs)
    : compression_(compression), codecs_(codecs), inflater_(libdeflate_alloc_decompressor()) {}

Expansion ExrInflater::expand(std::span<const std::byte> packed, std::span<std::byte> out) {
  if (compression_ == EXR_COMPRESSION_NONE) return Expansion::damaged;
  shuffled_.resize_uninitialised(out.size());
  if (compression_ == EXR_COMPRESSION_RLE) {
    if (expand_exr_runs(packed, shuffled_.span()) != Expansion::done) return Expansion::damaged;
  } else {
    // Without a place to tell the size to, libdeflate insists on filling the output exactly.
    const auto result = libdeflate_zlib_decompress(inflater_.get(), packed.data(), packed.size(),
                                                   shuffled_.data(), shuffled_.size(), nullptr);
    if (result != LIBDEFLATE_SUCCESS) return Expansion::damaged;
  }
  codecs_.undo_predictor_and_split(shuffled_.data(), out.size(), out.data());
  return Expansion::done;
}

Expansion expand_exr_runs(std::span<const std::byte> packed, std::span<std::byte> out) {
  const std::byte* in = packed.data();
  const std::byte* const in_end = in + packed.size();
  std::byte* to = out.data();
  std::byte* const to_end = to + out.size();
  while (in < in_end) {
    const auto count = static_cast<std::int8_t>(*in++);
    const std::ptrdiff_t length = count < 0 ? -count : count + 1;
    const std::ptrdiff_t consumed = count < 0 ? length : 1;
    if (in_end - in < consumed || to_end - to < length) return Expansion::damaged;
    if (count < 0) {
      std::memcpy(to, in, static_cast<std::size_t>(length));
    } else {
      std::memset(to, std::to_integer<int>(*in), static_cast<std::size_t>(length));
    }
    in += consumed;
    to += length;
  }
  return to == to_end ? Expansion::done : Expansion::damaged;
}

}  // namespace shoal
