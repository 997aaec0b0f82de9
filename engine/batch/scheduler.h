// Panoramas over threads: many small files and one huge one both keep every core busy.
//
// A worker takes the next panorama while there is one; when all are taken, it helps with those that
// are still open. So at most one panorama a worker is open at any time.
#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>

#include "core/result.h"
#include "transform/projector.h"

namespace shoal {

// What the scheduler asks for. All but `tick` are called by the workers, several at once.
struct JobSteps {
  // Opens job `index`. A null pointer: nothing to project, go on to finish.
  std::function<Result<std::unique_ptr<PanoramaProjection>>(std::size_t index)> open;

  // Asks for the first `limit` bytes that open() will read, without waiting for them; may be empty.
  // Called once for every job but the first, just before the job ahead of it is opened, and only
  // where there is one worker. Where there are several, one decodes while another waits for the
  // disk, and asking for more at once made cold runs slower: two workers over 64 half EXRs of 6 MB
  // took 1.0 s with it and 0.55 s without. One worker gains up to half of the time (1.5 s, 0.7 s
  // over uncompressed ones).
  std::function<void(std::size_t index, std::uint64_t limit)> prefetch;

  // Called once for every job that was opened or failed to: after all of its bands are projected,
  // or with the first error that was met. `projection` is null where open gave none.
  std::function<void(std::size_t index, PanoramaProjection* projection, Status status)> finish;

  // Called by the calling thread about ten times a second. May be empty: then the calling thread is
  // one of the workers, which spares small work the time that starting a thread takes.
  std::function<void()> tick;
};

// The most that is asked for ahead of its use.
inline constexpr std::uint64_t kPrefetchBytes = std::uint64_t{256} << 20;

// Runs jobs 0 .. count-1, begun in this order, on `threads` workers at most, as many as find work,
// and returns when all have finished. Once `stop` is true no further job begins, and those that are
// open finish with ErrorCode::interrupted. `pixels_done` grows as bands are projected. An exception
// in a step ends its job (ErrorCode::internal); where `finish` itself throws, it is called once
// more with that.
void run_jobs(std::size_t count, int threads, const std::atomic<bool>& stop,
              std::atomic<std::int64_t>& pixels_done, const JobSteps& steps);

// The number of processors that this process may use; at least 1.
[[nodiscard]] int default_thread_count();

}  // namespace shoal
