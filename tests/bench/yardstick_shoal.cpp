#include <libdeflate.h>

#include <algorithm>
#include <atomic>
#include <memory>
#include <mutex>

#include "batch/scheduler.h"
#include "bench/exr_chunks.h"
#include "bench/yardstick.h"
#include "transform/projector.h"

namespace shoal::bench {
namespace {

struct FreeInflater {
  void operator()(libdeflate_decompressor* inflater) const {
    libdeflate_free_decompressor(inflater);
  }
};

Status inflate(const ExrChunks& chunks, libdeflate_decompressor* inflater,
               std::vector<std::byte>& out) {
  out.resize(std::max(out.size(), chunks.largest_unpacked));
  for (const auto& chunk : chunks.chunks) {
    if (chunk.packed_size == chunk.unpacked_size) continue;
    const auto packed = chunks.packed(chunk);
    if (libdeflate_zlib_decompress(inflater, packed.data(), packed.size(), out.data(),
                                   chunk.unpacked_size, nullptr) != LIBDEFLATE_SUCCESS) {
      return Error{ErrorCode::malformed, "a chunk does not inflate; is it ZIP or ZIPS?", "", ""};
    }
  }
  return {};
}

}  // namespace

Seconds time_inflate(const YardstickWork& work) {
  std::vector<ExrChunks> files;
  for (const std::string& file : work.files) {
    SHOAL_ASSIGN_OR_RETURN(chunks, read_exr_chunks(file));
    files.push_back(std::move(chunks));
  }
  const std::unique_ptr<libdeflate_decompressor, FreeInflater> inflater(
      libdeflate_alloc_decompressor());
  std::vector<std::byte> out;
  return repeated(work.repeat, [&]() -> Status {
    for (const ExrChunks& chunks : files) {
      SHOAL_RETURN_IF_ERROR(inflate(chunks, inflater.get(), out));
    }
    return {};
  });
}

Seconds time_shoal(const YardstickWork& work) {
  ProjectionSettings settings;
  settings.degree = work.degree;
  ProjectionTables tables;
  const std::atomic<bool> stop{false};
  return repeated(work.repeat, [&]() -> Status {
    std::atomic<std::int64_t> pixels_done{0};
    std::mutex mutex;
    Status failure;
    JobSteps steps;
    steps.open = [&](std::size_t index) {
      return PanoramaProjection::open(work.files[index], {}, settings, tables);
    };
    steps.finish = [&](std::size_t, PanoramaProjection* projection, Status status) {
      if (status) {
        if (auto finished = projection->finish(); !finished) status = std::move(finished).error();
      }
      const std::scoped_lock lock(mutex);
      if (!status) failure = std::move(status);
    };
    steps.tick = [] {};
    run_jobs(work.files.size(), work.threads, stop, pixels_done, steps);
    return failure;
  });
}

}  // namespace shoal::bench
