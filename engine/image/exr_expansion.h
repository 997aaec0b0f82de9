// What those who expand the chunks of EXR files have in common.
#pragma once

#include <cstddef>
#include <span>

#include "core/row_band.h"

namespace shoal {

enum class Expansion { done, damaged };

// What a chunk holds: `rows` lines of `width` pixels; of each line the channels, in the file's
// order, one after the other.
struct ExrChunkShape {
  std::span<const SampleType> channels;
  std::size_t width = 0;
  std::size_t rows = 0;
};

}  // namespace shoal
