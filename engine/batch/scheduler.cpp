#include "batch/scheduler.h"

#include <sched.h>

#include <algorithm>
#include <chrono>
#include <condition_variable>
#include <exception>
#include <list>
#include <mutex>
#include <thread>
#include <utility>
#include <vector>

namespace shoal {
namespace {

// A panorama that some workers are at.
struct OpenJob {
  std::size_t index = 0;
  std::unique_ptr<PanoramaProjection> projection;
  int worker_count = 0;
  Status status;
};

// What a library throws ends one panorama, not the run.
template <typename Step>
auto guarded(const Step& step) -> decltype(step()) {
  try {
    return step();
  } catch (const std::exception& exception) {
    return Error{ErrorCode::internal, std::string("unexpected: ") + exception.what(), "",
                 "please report this"};
  }
}

class Pool {
 public:
  Pool(std::size_t count, const std::atomic<bool>& stop, std::atomic<std::int64_t>& pixels_done,
       const JobSteps& steps)
      : count_(count), stop_(stop), pixels_done_(pixels_done), steps_(steps) {}

  void run(int threads) {
    most_ = threads;
    prefetches_ = threads == 1 && steps_.prefetch;
    std::unique_lock lock(mutex_);
    const bool works_here = !steps_.tick || !enlist();
    if (works_here) {
      ++started_;
      ++running_;
    }
    const auto at_once = static_cast<int>(std::min(static_cast<std::size_t>(threads), count_));
    while (started_ < at_once && enlist()) {
    }
    if (works_here) {
      lock.unlock();
      work();
      lock.lock();
    }
    while (!ended_.wait_for(lock, std::chrono::milliseconds(100), [&] { return running_ == 0; })) {
      lock.unlock();
      if (steps_.tick) steps_.tick();
      lock.lock();
    }
  }

 private:
  using JobPosition = std::list<OpenJob>::iterator;

  // Starts one more worker where there may be. As many as there are jobs start at once, others when
  // a job has bands for them, so one small file starts none (0.2 ms). The system may refuse; then
  // those that run do all of the work. The mutex is held.
  bool enlist() {
    if (started_ >= most_) return false;
    try {
      workers_.emplace_back([this] { work(); });
    } catch (const std::exception&) {
      most_ = started_;
      return false;
    }
    ++started_;
    ++running_;
    return true;
  }

  void work() {
    while (begin_next() || help()) {
    }
    const std::scoped_lock lock(mutex_);
    if (--running_ == 0) ended_.notify_all();
  }

  // Takes the next job, if there is one, and works on it.
  bool begin_next() {
    const std::size_t index = next_++;
    if (index >= count_ || stop_) return false;
    if (prefetches_ && index + 1 < count_) steps_.prefetch(index + 1, kPrefetchBytes);
    auto opened = guarded([&] { return steps_.open(index); });
    if (!opened || *opened == nullptr) {
      finish(index, nullptr, opened ? Status() : Status(std::move(opened).error()));
      return true;
    }
    std::unique_lock lock(mutex_);
    const JobPosition job = open_.insert(open_.end(), OpenJob{});
    job->index = index;
    job->projection = std::move(*opened);
    changed_.notify_all();
    work_on(job, lock);
    return true;
  }

  // Joins the work on an open job; waits where others are about to open one. False: all is done.
  bool help() {
    std::unique_lock lock(mutex_);
    const auto wants_help = [](const OpenJob& job) { return job.projection->wants_workers(); };
    const JobPosition job = std::ranges::find_if(open_, wants_help);
    if (job != open_.end()) {
      work_on(job, lock);
      return true;
    }
    // Nobody opens anything once all workers wait here or are at work on what is open.
    ++idle_;
    changed_.notify_all();
    const auto nothing_to_come = [&] { return idle_ + busy_ >= running_; };
    changed_.wait(lock, [&] {
      return nothing_to_come() || std::ranges::find_if(open_, wants_help) != open_.end();
    });
    const bool more = std::ranges::find_if(open_, wants_help) != open_.end();
    if (more) --idle_;
    return more;
  }

  void work_on(JobPosition job, std::unique_lock<std::mutex>& lock) {
    ++job->worker_count;
    ++busy_;
    changed_.notify_all();
    PanoramaProjection* projection = job->projection.get();
    if (has_bands_for_two(*projection)) enlist();
    lock.unlock();
    Status status = guarded([&] { return projection->work(stop_, pixels_done_); });
    lock.lock();
    --busy_;
    if (!status && job->status) job->status = std::move(status);
    if (--job->worker_count > 0) return;
    OpenJob finished = std::move(*job);
    open_.erase(job);
    lock.unlock();
    finish(finished.index, finished.projection.get(), std::move(finished.status));
    lock.lock();
  }

  void finish(std::size_t index, PanoramaProjection* projection, Status status) {
    const auto tell = [&](PanoramaProjection* of, Status with) {
      return guarded([&]() -> Status {
        steps_.finish(index, of, std::move(with));
        return {};
      });
    };
    Status told = tell(projection, std::move(status));
    if (!told) static_cast<void>(tell(nullptr, std::move(told)));
  }

  static bool has_bands_for_two(const PanoramaProjection& projection) {
    const PictureInfo& info = projection.info();
    return info.band_access == BandAccess::random && info.band_count > 1 &&
           projection.wants_workers();
  }

  const std::size_t count_;
  const std::atomic<bool>& stop_;
  std::atomic<std::int64_t>& pixels_done_;
  const JobSteps& steps_;

  std::atomic<std::size_t> next_{0};
  bool prefetches_ = false;
  std::mutex mutex_;  // guards what follows
  std::condition_variable changed_;
  std::condition_variable ended_;
  std::list<OpenJob> open_;
  int most_ = 0;  // workers that may be started
  int started_ = 0;
  int running_ = 0;                    // workers that have not left
  int idle_ = 0;                       // workers that wait for something to help with
  int busy_ = 0;                       // workers inside work_on
  std::vector<std::jthread> workers_;  // all but the calling thread
};

}  // namespace

void run_jobs(std::size_t count, int threads, const std::atomic<bool>& stop,
              std::atomic<std::int64_t>& pixels_done, const JobSteps& steps) {
  Pool(count, stop, pixels_done, steps).run(std::max(1, threads));
}

int default_thread_count() {
  cpu_set_t processors;
  if (sched_getaffinity(0, sizeof processors, &processors) == 0) {
    return std::max(1, CPU_COUNT(&processors));
  }
  return static_cast<int>(std::max(1U, std::thread::hardware_concurrency()));
}

}  // namespace shoal
