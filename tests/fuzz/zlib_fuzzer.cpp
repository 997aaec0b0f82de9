// Any bytes as several zlib streams in one call: the verdict and the bytes are libdeflate's, and
// whatever runs in the lanes beside a stream does not matter to it.
#include <algorithm>
#include <optional>
#include <vector>

#include "fuzz/fuzz_input.h"
#include "image/zlib_inflater.h"
#include "image/zlib_streams.h"

namespace shoal::test {
namespace {

constexpr std::size_t kMostStreams = 6;  // more than there are lanes
constexpr std::size_t kSizeOfDamaged = 500;

struct Stream {
  Bytes packed;
  std::size_t size = 0;
};

// A checksum is hard to guess, so the stream gets that of what libdeflate makes of its blocks.
Stream stream_of(std::span<const std::uint8_t> blocks) {
  Bytes bytes;
  for (const std::uint8_t byte : blocks) bytes.push_back(std::byte{byte});
  WrappedBlocks wrapped = wrap_blocks(bytes);
  return {std::move(wrapped.stream), wrapped.is_sound ? wrapped.size : kSizeOfDamaged};
}

// The first byte says how many streams the others are cut into.
std::vector<Stream> streams_of(std::span<const std::uint8_t> data) {
  std::vector<Stream> streams;
  const std::size_t count = 1 + data[0] % kMostStreams;
  const auto bytes = data.subspan(1);
  for (std::size_t i = 0; i < count; ++i) {
    const std::size_t begin = bytes.size() * i / count;
    streams.push_back(stream_of(bytes.subspan(begin, bytes.size() * (i + 1) / count - begin)));
  }
  return streams;
}

void check(const std::vector<Stream>& streams) {
  static ZlibInflater inflater;
  std::vector<ZlibInflater::Job> jobs;
  for (const Stream& stream : streams) jobs.push_back({stream.packed, stream.size});
  std::vector<std::optional<Bytes>> outcomes(streams.size());
  const std::size_t first =
      inflater.inflate(jobs, [&](std::size_t job, std::span<std::byte> bytes) {
        outcomes[job].emplace(bytes.begin(), bytes.end());
      });
  const auto missing = std::ranges::find_if(outcomes, [](const auto& outcome) { return !outcome; });
  demand(first == static_cast<std::size_t>(missing - outcomes.begin()), "the first damaged stream");
  for (std::size_t i = 0; i < streams.size(); ++i) {
    demand(outcomes[i] == inflate_with_libdeflate(streams[i].packed, streams[i].size),
           "a stream inflates to what libdeflate makes of it");
  }
}

}  // namespace
}  // namespace shoal::test

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size > 0) shoal::test::check(shoal::test::streams_of({data, size}));
  return 0;
}
