// The byte and sample shuffles of kernels/ for image/, which knows no kernels.
#pragma once

#include "image/chunk_codecs.h"

namespace shoal {

[[nodiscard]] ChunkCodecs simd_chunk_codecs();

}  // namespace shoal
