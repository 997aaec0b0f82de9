#include "image/exr_inflate.h"

#include <cstdint>
#include <cstring>

#include "image/exr_pxr24.h"

namespace shoal {

bool ExrInflater::can_expand(exr_compression_t compression) {
  switch (compression) {
    case EXR_COMPRESSION_NONE:
    case EXR_COMPRESSION_RLE:
    case EXR_COMPRESSION_ZIPS:
    case EXR_COMPRESSION_ZIP:
    case EXR_COMPRESSION_PIZ:
    case EXR_COMPRESSION_PXR24:
      return true;
    default:
      return false;
  }
}

ExrInflater::ExrInflater(exr_compression_t compression, const ChunkCodecs& codecs)
    : compression_(compression), codecs_(codecs) {
  if (compression == EXR_COMPRESSION_PIZ) piz_ = std::make_unique<PizExpander>(codecs);
}

std::size_t ExrInflater::expand(std::span<const Chunk> chunks) {
  switch (compression_) {
    case EXR_COMPRESSION_ZIPS:
    case EXR_COMPRESSION_ZIP:
    case EXR_COMPRESSION_PXR24:
      return inflate(chunks);
    default:
      for (std::size_t i = 0; i < chunks.size(); ++i) {
        if (expand_one(chunks[i]) != Expansion::done) return i;
      }
      return chunks.size();
  }
}

Expansion ExrInflater::expand_one(const Chunk& chunk) {
  if (chunk.packed.size() == chunk.out.size()) {
    std::memcpy(chunk.out.data(), chunk.packed.data(), chunk.out.size());
    return Expansion::done;
  }
  if (piz_) return piz_->expand(chunk.packed, chunk.shape, chunk.out);
  return compression_ == EXR_COMPRESSION_RLE ? expand_runs(chunk) : Expansion::damaged;
}

Expansion ExrInflater::expand_runs(const Chunk& chunk) {
  shuffled_.resize_uninitialised(chunk.out.size());
  if (expand_exr_runs(chunk.packed, shuffled_.span()) != Expansion::done) {
    return Expansion::damaged;
  }
  codecs_.undo_predictor_and_split(shuffled_.data(), chunk.out.size(), chunk.out.data());
  return Expansion::done;
}

std::size_t ExrInflater::inflate(std::span<const Chunk> chunks) {
  const bool is_pxr24 = compression_ == EXR_COMPRESSION_PXR24;
  jobs_.clear();
  chunk_of_job_.clear();
  for (std::size_t i = 0; i < chunks.size(); ++i) {
    const Chunk& chunk = chunks[i];
    if (chunk.packed.size() == chunk.out.size()) {
      std::memcpy(chunk.out.data(), chunk.packed.data(), chunk.out.size());
      continue;
    }
    jobs_.push_back({chunk.packed, is_pxr24 ? pxr24_planes_size(chunk.shape) : chunk.out.size()});
    chunk_of_job_.push_back(i);
  }
  const std::size_t damaged =
      inflater_.inflate(jobs_, [&](std::size_t job, std::span<std::byte> bytes) {
        const Chunk& chunk = chunks[chunk_of_job_[job]];
        if (is_pxr24) {
          undo_pxr24_planes(bytes.data(), chunk.shape, codecs_, chunk.out.data());
        } else {
          codecs_.undo_predictor_and_split(bytes.data(), bytes.size(), chunk.out.data());
        }
      });
  return damaged == jobs_.size() ? chunks.size() : chunk_of_job_[damaged];
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
