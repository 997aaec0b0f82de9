// PXR24, OpenEXR's compression that rounds floats to 24 bits.
//
// A chunk is a zlib stream. In it, line after line, the samples of each channel stand as planes of
// bytes, the highest bytes first: 2 planes of a half, 3 of a float (whose lowest bits were rounded
// away), 4 of an integer. They hold each sample's difference, of bit patterns, to its left
// neighbour's; the first one's to zero. (OpenEXR's technical introduction and its file layout.)
#pragma once

#include <cstddef>

#include "image/chunk_codecs.h"
#include "image/exr_expansion.h"

namespace shoal {

// The bytes that a chunk inflates to.
[[nodiscard]] std::size_t pxr24_planes_size(const ExrChunkShape& shape);

// Turns pxr24_planes_size(shape) bytes of `planes` into the lines of the chunk.
void undo_pxr24_planes(const std::byte* planes, const ExrChunkShape& shape,
                       const ChunkCodecs& codecs, std::byte* lines);

}  // namespace shoal
