// Inflates many independent zlib streams, several at a time in one thread.
#pragma once

#include <array>
#include <cstddef>
#include <functional>
#include <memory>
#include <span>

#include "core/aligned_buffer.h"
#include "image/deflate_stream.h"

namespace shoal {

// Decoding one stream is a chain: only a code's look-up tells where the next code begins, so that a
// literal takes about 9 cycles, while the processor could do several times that work. Streams know
// nothing of each other, so kLanes of them advance in turns, symbol by symbol, and their chains
// overlap. Literals that go in pairs through wider tables, which speed up text, would not help: in
// EXR's chunks they are noise of 6 to 8 bits each.
class ZlibInflater {
 public:
  struct Job {
    std::span<const std::byte> packed;
    std::size_t size = 0;  // of what it inflates to
  };
  // Takes what job number `job` inflates to; the bytes may be overwritten, and last for the call.
  using Take = std::function<void(std::size_t job, std::span<std::byte> bytes)>;

  // 2 lanes are 1.15 times as fast as libdeflate, 3 lanes 1.3 times, 4 lanes 1.5 times (half ZIP
  // chunks, Zen 4); more would not fit into the processor's registers.
  static constexpr std::size_t kLanes = 4;

  // Inflates all jobs and hands each that is sound to `take`, in any order. Returns the number of
  // the first damaged job, or jobs.size(). Sound is what fills `size` bytes exactly and has the
  // right checksum. The scratch memory grows to kLanes times the largest job met.
  std::size_t inflate(std::span<const Job> jobs, const Take& take);

 private:
  // What is in a lane's stream, and where it goes.
  struct Cargo {
    std::size_t job = 0;
    AlignedBuffer<std::byte> bytes;
  };
  // Of one call of inflate().
  struct Work {
    std::span<const Job> jobs;
    const Take& take;
    std::size_t next = 0;
    std::size_t first_damaged = 0;
  };

  bool load_next(std::size_t lane, Work& work);
  bool advance(std::size_t lane, Work& work);

  // Side by side, so that the fast loop reaches all of them from one register.
  std::unique_ptr<std::array<DeflateStream, kLanes>> streams_;
  std::array<Cargo, kLanes> cargo_;
};

}  // namespace shoal
