#include "batch/scheduler.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <fstream>
#include <mutex>
#include <numeric>
#include <optional>
#include <set>
#include <stdexcept>
#include <thread>
#include <vector>

#include "support/made_picture.h"
#include "support/temporary_folder.h"

namespace shoal {
namespace {

using test::make_noisy_picture;
using test::TemporaryFolder;
using test::write_picture;

constexpr std::array kThreadCounts = {1, 2, 7};

using Opened = Result<std::unique_ptr<PanoramaProjection>>;

// What was told of one job.
struct Told {
  int finished = 0;
  bool had_projection = false;
  std::optional<Error> error;
  std::optional<Coefficients> radiance;
};

class SchedulerTest : public ::testing::Test {
 protected:
  // Adds a job that projects a picture of this size.
  void add_panorama(int width, int height, MapFormat format, int rows_per_band = 0) {
    const std::string name = std::to_string(files_.size());
    files_.push_back(folder_ / name);
    write_picture(make_noisy_picture(width, height, files_.size()), format, files_.back());
    rows_per_band_.push_back(rows_per_band);
    pixels_ += static_cast<std::int64_t>(width) * height;
  }

  Opened open_file(std::size_t index) {
    ReadOptions read;
    read.rows_per_band = rows_per_band_[index];
    return PanoramaProjection::open(files_[index], read, {}, tables_);
  }

  // Runs `count` jobs. `open` may do as it likes; what finish is told is kept.
  void run(std::size_t count, int threads, const std::function<Opened(std::size_t)>& open,
           const std::function<void(std::size_t)>& on_finish = {}) {
    told_.assign(count, {});
    pixels_done_ = 0;
    JobSteps steps;
    steps.open = open;
    steps.finish = [&](std::size_t index, PanoramaProjection* projection, Status status) {
      {
        const std::scoped_lock lock(mutex_);
        Told& told = told_.at(index);
        ++told.finished;
        told.had_projection = projection != nullptr;
        if (!status) {
          told.error = status.error();
        } else if (projection != nullptr) {
          auto result = projection->finish();
          if (result) told.radiance = result->radiance;
          if (!result) told.error = result.error();
        }
      }
      if (on_finish) on_finish(index);
    };
    steps.tick = [&] { tick_threads_.push_back(std::this_thread::get_id()); };
    run_jobs(count, threads, stop_, pixels_done_, steps);
  }

  void run_files(int threads) {
    run(files_.size(), threads, [this](std::size_t index) { return open_file(index); });
  }

  void expect_each_finished_once() {
    for (std::size_t i = 0; i < told_.size(); ++i) EXPECT_EQ(told_[i].finished, 1) << "job " << i;
  }

  TemporaryFolder folder_;
  std::vector<std::filesystem::path> files_;
  std::vector<int> rows_per_band_;
  std::int64_t pixels_ = 0;
  ProjectionTables tables_;
  std::atomic<bool> stop_{false};
  std::atomic<std::int64_t> pixels_done_{0};
  std::vector<std::thread::id> tick_threads_;
  std::mutex mutex_;  // guards told_ while jobs run
  std::vector<Told> told_;
};

// One file that could keep all workers busy (512 bands, in any order) between many small ones of
// both kinds of access. Its result must not depend on who helped.
TEST_F(SchedulerTest, EveryJobFinishesOnceWithTheSameBitsForEveryThreadCount) {
  for (int i = 0; i < 8; ++i) add_panorama(16 + i, 8, MapFormat::hdr);
  add_panorama(256, 512, MapFormat::exr_float, 1);
  for (int i = 0; i < 30; ++i) {
    add_panorama(20 + i, 10, i % 2 ? MapFormat::hdr : MapFormat::exr_half);
  }
  std::vector<Coefficients> alone;
  for (std::size_t i = 0; i < files_.size(); ++i) {
    alone.push_back(project_panorama(files_[i], {}, {}, tables_)->radiance);
  }
  for (const int threads : kThreadCounts) {
    SCOPED_TRACE(threads);
    run_files(threads);
    expect_each_finished_once();
    for (std::size_t i = 0; i < files_.size(); ++i) {
      ASSERT_TRUE(told_[i].radiance) << i;
      EXPECT_EQ(*told_[i].radiance, alone[i]) << i;
    }
    EXPECT_EQ(pixels_done_, pixels_);
  }
}

TEST_F(SchedulerTest, JobsBeginInOrderAndNeverMoreThanOneAWorkerIsOpen) {
  for (int i = 0; i < 30; ++i) add_panorama(32, 48, MapFormat::exr_float, 1);
  for (const int threads : kThreadCounts) {
    SCOPED_TRACE(threads);
    std::atomic<int> open_now{0};
    std::atomic<int> most{0};
    std::vector<std::size_t> begun;
    run(
        files_.size(), threads,
        [&](std::size_t index) {
          const int now = ++open_now;
          int before = most;
          while (before < now && !most.compare_exchange_weak(before, now)) {
          }
          {
            const std::scoped_lock lock(mutex_);
            begun.push_back(index);
          }
          return open_file(index);
        },
        [&](std::size_t) { --open_now; });
    expect_each_finished_once();
    EXPECT_LE(most, threads);
    EXPECT_EQ(std::set(begun.begin(), begun.end()).size(), files_.size());
    if (threads == 1) {
      EXPECT_TRUE(std::ranges::is_sorted(begun));
    }
  }
}

TEST_F(SchedulerTest, FailingToOpenEndsThatJobAlone) {
  for (int i = 0; i < 12; ++i) add_panorama(16, 8, MapFormat::hdr);
  for (const int threads : kThreadCounts) {
    SCOPED_TRACE(threads);
    run(files_.size(), threads, [&](std::size_t index) -> Opened {
      if (index % 3 == 0)
        return Error{ErrorCode::malformed, "job " + std::to_string(index), "", ""};
      return open_file(index);
    });
    expect_each_finished_once();
    for (std::size_t i = 0; i < files_.size(); ++i) {
      EXPECT_EQ(told_[i].error.has_value(), i % 3 == 0) << i;
      EXPECT_EQ(told_[i].had_projection, i % 3 != 0) << i;
      if (told_[i].error) {
        EXPECT_EQ(told_[i].error->what, "job " + std::to_string(i));
      }
    }
  }
}

// The last band's bytes are overwritten: the file opens, and one of its bands fails.
TEST_F(SchedulerTest, ABandThatFailsEndsItsJobAlone) {
  for (int i = 0; i < 6; ++i) add_panorama(64, 160, MapFormat::exr_float);
  {
    std::fstream file(files_[2], std::ios::binary | std::ios::in | std::ios::out);
    file.seekp(-400, std::ios::end);
    file << std::string(400, '\xff');
  }
  for (const int threads : kThreadCounts) {
    SCOPED_TRACE(threads);
    run_files(threads);
    expect_each_finished_once();
    for (std::size_t i = 0; i < files_.size(); ++i) {
      EXPECT_EQ(told_[i].error.has_value(), i == 2) << i;
    }
  }
}

TEST_F(SchedulerTest, NullProjectionsGoStraightToFinish) {
  for (const int threads : kThreadCounts) {
    run(50, threads, [](std::size_t) -> Opened { return std::unique_ptr<PanoramaProjection>(); });
    expect_each_finished_once();
    for (const Told& told : told_) {
      EXPECT_FALSE(told.error);
      EXPECT_FALSE(told.had_projection);
    }
  }
}

TEST_F(SchedulerTest, AnExceptionInOpenEndsItsJobAlone) {
  for (const int threads : kThreadCounts) {
    run(20, threads, [](std::size_t index) -> Opened {
      if (index == 7) throw std::runtime_error("bang");
      return std::unique_ptr<PanoramaProjection>();
    });
    expect_each_finished_once();
    for (std::size_t i = 0; i < told_.size(); ++i) EXPECT_EQ(told_[i].error.has_value(), i == 7);
    EXPECT_EQ(told_[7].error->code, ErrorCode::internal);
    EXPECT_NE(told_[7].error->what.find("bang"), std::string::npos);
  }
}

TEST_F(SchedulerTest, AnExceptionInFinishIsToldToFinishOnceMore) {
  for (int i = 0; i < 6; ++i) add_panorama(16, 8, MapFormat::hdr);
  for (const int threads : kThreadCounts) {
    run(
        files_.size(), threads, [this](std::size_t index) { return open_file(index); },
        [](std::size_t index) {
          if (index % 2 == 1) throw std::runtime_error("bang");
        });
    for (std::size_t i = 0; i < told_.size(); ++i) {
      EXPECT_EQ(told_[i].finished, i % 2 == 1 ? 2 : 1);
      EXPECT_EQ(told_[i].error.has_value(), i % 2 == 1);
      EXPECT_EQ(told_[i].had_projection, i % 2 == 0);
    }
  }
}

TEST_F(SchedulerTest, AfterStopNothingBeginsAndWhatIsOpenFinishes) {
  for (int i = 0; i < 40; ++i) add_panorama(64, 160, MapFormat::exr_float, 1);
  for (const int threads : kThreadCounts) {
    SCOPED_TRACE(threads);
    stop_ = false;
    int finished = 0;
    std::vector<bool> begun(files_.size());
    run(
        files_.size(), threads,
        [&](std::size_t index) {
          {
            const std::scoped_lock lock(mutex_);
            begun[index] = true;
          }
          return open_file(index);
        },
        [&](std::size_t) {
          const std::scoped_lock lock(mutex_);
          if (++finished == 6) stop_ = true;
        });
    // Each worker had at most one job in hand when the stop came.
    EXPECT_LE(std::ranges::count(begun, true), 6 + threads);
    for (std::size_t i = 0; i < files_.size(); ++i) {
      EXPECT_EQ(told_[i].finished, begun[i] ? 1 : 0) << i;
      if (told_[i].error) {
        EXPECT_EQ(told_[i].error->code, ErrorCode::interrupted);
      }
    }
  }
  stop_ = true;
  run(files_.size(), 2, [this](std::size_t index) { return open_file(index); });
  for (const Told& told : told_) EXPECT_EQ(told.finished, 0);
}

// Ends of pools are where a worker could be left waiting for ever, or leave too early.
TEST_F(SchedulerTest, ManyShortPoolsAllEnd) {
  add_panorama(8, 64, MapFormat::exr_float, 1);
  add_panorama(8, 4, MapFormat::hdr);
  for (int round = 0; round < 300; ++round) {
    const std::size_t count = round % 5;
    run(count, 1 + round % 7, [&](std::size_t index) -> Opened {
      if ((round + index) % 4 == 0) return Error{ErrorCode::malformed, "no", "", ""};
      if ((round + index) % 4 == 1) return std::unique_ptr<PanoramaProjection>();
      return open_file(index % 2);
    });
    expect_each_finished_once();
  }
}

TEST_F(SchedulerTest, TheCallingThreadTicksWhileWorkersWork) {
  run(1, 2, [](std::size_t) -> Opened {
    std::this_thread::sleep_for(std::chrono::milliseconds(450));
    return std::unique_ptr<PanoramaProjection>();
  });
  EXPECT_GE(tick_threads_.size(), 2u);
  for (const auto& id : tick_threads_) EXPECT_EQ(id, std::this_thread::get_id());
}

// Without ticks the calling thread works: alone where there is nothing for a second one, first of
// several otherwise.
TEST_F(SchedulerTest, WithoutTicksTheCallingThreadIsAWorker) {
  add_panorama(16, 8, MapFormat::hdr);
  const auto threads_that_opened = [&](std::size_t count, int threads) {
    std::set<std::thread::id> ids;
    JobSteps steps;
    steps.open = [&](std::size_t) {
      {
        const std::scoped_lock lock(mutex_);
        ids.insert(std::this_thread::get_id());
      }
      if (count > 1) std::this_thread::sleep_for(std::chrono::milliseconds(50));
      return open_file(0);
    };
    steps.finish = [](std::size_t, PanoramaProjection*, const Status& status) {
      EXPECT_TRUE(status);
    };
    run_jobs(count, threads, stop_, pixels_done_, steps);
    return ids;
  };
  const std::set alone{std::this_thread::get_id()};
  EXPECT_EQ(threads_that_opened(1, 7), alone);
  EXPECT_EQ(threads_that_opened(5, 1), alone);
  const auto several = threads_that_opened(8, 3);
  EXPECT_TRUE(several.contains(std::this_thread::get_id()));
  EXPECT_EQ(several.size(), 3u) << "each of eight jobs takes 50 ms";
}

// One worker asks for each job before it opens the one ahead of it. Several ask for none.
TEST_F(SchedulerTest, OneWorkerAsksForTheNextJob) {
  constexpr std::size_t kCount = 20;
  add_panorama(16, 8, MapFormat::hdr);
  for (const int threads : kThreadCounts) {
    std::vector<std::size_t> asked;
    JobSteps steps;
    steps.open = [&](std::size_t index) {
      if (threads == 1) {
        EXPECT_EQ(asked.size(), std::min(index + 1, kCount - 1));
      }
      return open_file(0);
    };
    steps.prefetch = [&](std::size_t index, std::uint64_t limit) {
      asked.push_back(index);
      EXPECT_EQ(limit, kPrefetchBytes);
    };
    steps.finish = [](std::size_t, PanoramaProjection*, const Status& status) {
      EXPECT_TRUE(status);
    };
    run_jobs(kCount, threads, stop_, pixels_done_, steps);
    std::vector<std::size_t> expected(threads == 1 ? kCount - 1 : 0);
    std::iota(expected.begin(), expected.end(), std::size_t{1});
    EXPECT_EQ(asked, expected) << threads << " threads";
  }
}

TEST(Scheduler, ThereIsAtLeastOneProcessor) { EXPECT_GE(default_thread_count(), 1); }

}  // namespace
}  // namespace shoal
