// What workers find of files, taken in the order of the files.
#pragma once

#include <cstddef>
#include <functional>
#include <mutex>
#include <optional>
#include <utility>
#include <vector>

namespace shoal {

template <typename Outcome>
class InOrder {
 public:
  // One call at a time, in the order of the indices.
  using Take = std::function<void(std::size_t index, Outcome& outcome)>;

  InOrder(std::size_t count, Take take) : take_(std::move(take)), outcomes_(count) {}

  // From any thread, once an index: taken as soon as all before it are there.
  void bring(std::size_t index, Outcome outcome) {
    const std::scoped_lock lock(mutex_);
    outcomes_[index].emplace(std::move(outcome));
    for (; next_ < outcomes_.size() && outcomes_[next_]; ++next_) {
      take_(next_, *outcomes_[next_]);
      outcomes_[next_].reset();
    }
  }

 private:
  Take take_;
  std::mutex mutex_;  // guards what follows
  std::vector<std::optional<Outcome>> outcomes_;
  std::size_t next_ = 0;
};

}  // namespace shoal
