#include "transform/ordered_sums.h"

#include <algorithm>
#include <cstdint>

namespace shoal {

OrderedSums::OrderedSums(int row_count, std::size_t width) : row_count_(row_count), width_(width) {}

OrderedSums::Numbers OrderedSums::copy_of(std::span<const double> sums) {
  if (sums.empty()) return {};
  Numbers numbers;
  if (!spare_.empty()) {
    numbers = std::move(spare_.back());
    spare_.pop_back();
  }
  numbers.assign(sums.begin(), sums.end());
  return numbers;
}

void OrderedSums::add(int row, std::span<const double> sums) {
  const std::scoped_lock lock(mutex_);
  Numbers numbers = copy_of(sums);
  Place place{0, row};
  while (std::int64_t{1} << place.first < row_count_) {
    const auto [level, index] = place;
    const Place other{level, index ^ 1};
    // Beyond the last row there is nothing to wait for.
    const bool has_other = (std::int64_t{other.second} << level) < row_count_;
    if (has_other) {
      const auto found = waiting_.find(other);
      if (found == waiting_.end()) break;
      Numbers more = std::move(found->second);
      waiting_.erase(found);
      if (numbers.empty()) {
        numbers = std::move(more);
      } else if (!more.empty()) {
        for (std::size_t i = 0; i < width_; ++i) numbers[i] += more[i];
        spare_.push_back(std::move(more));
      }
    }
    place = {level + 1, index / 2};
  }
  waiting_.emplace(place, std::move(numbers));
  most_waiting_ = std::max(most_waiting_, waiting_.size());
}

std::vector<double> OrderedSums::total() const {
  if (waiting_.empty() || waiting_.begin()->second.empty()) return Numbers(width_);
  return waiting_.begin()->second;
}

}  // namespace shoal
