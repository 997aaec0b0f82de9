// Sums over the rows of a picture that do not depend on who adds which row, or when.
//
// Rows are the leaves of a binary tree that only their number decides: every inner node is the sum
// of its two halves, made as soon as both are there. So the bits are the same for any order in
// which rows come, and rounding grows with the logarithm of their number. What waits are the roots
// of the largest whole subtrees: at most 2 log2(rows) for each run of neighbouring rows that are
// done, of which there are about as many as workers. Nobody ever waits for a row that is late.
#pragma once

#include <cstddef>
#include <map>
#include <mutex>
#include <span>
#include <utility>
#include <vector>

namespace shoal {

class OrderedSums {
 public:
  // Preconditions: row_count >= 1; width, of the numbers that a row has, >= 1.
  OrderedSums(int row_count, std::size_t width);

  // Every row once, by any thread; `sums` holds `width` numbers. An empty span stands for zeros.
  void add(int row, std::span<const double> sums);

  // After all rows. Zeros where rows are missing in all of the picture.
  [[nodiscard]] std::vector<double> total() const;

  // The most nodes that ever waited at once.
  [[nodiscard]] std::size_t most_waiting() const { return most_waiting_; }

 private:
  using Numbers = std::vector<double>;  // empty: zeros
  using Place = std::pair<int, int>;    // level, and index among the nodes of that level

  [[nodiscard]] Numbers copy_of(std::span<const double> sums);

  const int row_count_;
  const std::size_t width_;
  std::mutex mutex_;  // guards what follows
  std::map<Place, Numbers> waiting_;
  std::vector<Numbers> spare_;
  std::size_t most_waiting_ = 0;
};

}  // namespace shoal
