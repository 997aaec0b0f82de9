// What shoal is measured against, each in its own source file because of what it links.
//
// Every function does its work on the files once untimed (libraries start their threads, buffers
// get their pages), then `repeat` times, and returns the seconds of each time.
#pragma once

#include <chrono>
#include <string>
#include <vector>

#include "core/result.h"

namespace shoal::bench {

// Where a reader puts a file's samples: into a buffer of its own, whose pages the system maps while
// they are filled, or into the pages of the file before.
enum class SampleBuffer { fresh, reused };

struct YardstickWork {
  std::vector<std::string> files;
  int repeat = 1;
  int threads = 1;
  int degree = 2;
  SampleBuffer buffer = SampleBuffer::fresh;  // oiio; libsharp's threads reuse theirs
};

using Seconds = Result<std::vector<double>>;

// OpenImageIO opens each file and reads it to interleaved floats by ImageInput::read_image;
// `threads` is what it may use inside.
Seconds time_oiio(const YardstickWork& work);

// The same by `threads` threads, each with whole files, and libsharp's analysis of three channels
// to `degree`.
Seconds time_libsharp(const YardstickWork& work);

// libdeflate inflates the ZIP or ZIPS chunks of each file, which are read before and not timed.
Seconds time_inflate(const YardstickWork& work);

// shoal's own projection in this process, by `threads` workers.
Seconds time_shoal(const YardstickWork& work);

// OpenImageIO's version.
std::string oiio_version();

// Runs `once`, which returns a Status, as described above.
template <typename Once>
Seconds repeated(int repeat, const Once& once) {
  std::vector<double> seconds;
  for (int i = 0; i <= repeat; ++i) {
    const auto begin = std::chrono::steady_clock::now();
    SHOAL_RETURN_IF_ERROR(once());
    const std::chrono::duration<double> spent = std::chrono::steady_clock::now() - begin;
    if (i > 0) seconds.push_back(spent.count());
  }
  return seconds;
}

}  // namespace shoal::bench
