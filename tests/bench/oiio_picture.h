// A whole picture as OpenImageIO gives it.
#pragma once

#include <cstddef>
#include <memory>
#include <string>

#include "core/result.h"

namespace shoal::bench {

struct OiioPicture {
  int width = 0;
  int height = 0;
  int channel_count = 0;
  std::unique_ptr<float[]> samples;  // (height, width, channel_count)
  std::size_t capacity = 0;          // in samples; the buffer only grows
};

// Opens the file and reads it. Errors: unreadable.
Status read_with_oiio(const std::string& path, OiioPicture& picture);

// How many threads OpenImageIO, and OpenEXR below it, may use.
void set_oiio_threads(int threads);

}  // namespace shoal::bench
