#include "transform/ordered_sums.h"

#include <gtest/gtest.h>

#include <cmath>
#include <thread>

#include "support/random_numbers.h"

namespace shoal {
namespace {

constexpr std::size_t kWidth = 3;

std::vector<std::vector<double>> random_rows(int count) {
  test::RandomNumbers random(count);
  std::vector<std::vector<double>> rows(count);
  for (auto& row : rows) {
    for (std::size_t i = 0; i < kWidth; ++i) row.push_back(std::exp(random.between(-20.0, 20.0)));
  }
  return rows;
}

std::vector<double> total_in_order(const std::vector<std::vector<double>>& rows,
                                   const std::vector<int>& order) {
  OrderedSums sums(static_cast<int>(rows.size()), kWidth);
  for (const int row : order) sums.add(row, rows[row]);
  return sums.total();
}

std::vector<int> in_order(int count) {
  std::vector<int> order(count);
  for (int i = 0; i < count; ++i) order[i] = i;
  return order;
}

// Numbers over 17 orders of magnitude, whose sum depends on the order in nearly every bit.
TEST(OrderedSums, DoesNotDependOnTheOrderOfRows) {
  test::RandomNumbers random(7);
  for (const int count : {1, 2, 3, 5, 8, 100, 1023}) {
    const auto rows = random_rows(count);
    std::vector<int> order = in_order(count);
    const std::vector<double> expected = total_in_order(rows, order);
    for (std::size_t i = 0; i < kWidth; ++i) {
      long double exact = 0.0L;
      for (const auto& row : rows) exact += row[i];
      EXPECT_NEAR(expected[i], static_cast<double>(exact), 1e-14 * static_cast<double>(exact));
    }
    for (int shuffle = 0; shuffle < 10; ++shuffle) {
      for (int i = count - 1; i > 0; --i) std::swap(order[i], order[random.below(i + 1)]);
      EXPECT_EQ(total_in_order(rows, order), expected) << count;
    }
  }
}

TEST(OrderedSums, TakesEmptyRowsForZeros) {
  auto rows = random_rows(37);
  for (int i = 0; i < 37; i += 3) rows[i].assign(kWidth, 0.0);
  const std::vector<double> expected = total_in_order(rows, in_order(37));
  for (int i = 0; i < 37; i += 3) rows[i].clear();
  EXPECT_EQ(total_in_order(rows, in_order(37)), expected);
  EXPECT_EQ(total_in_order(std::vector<std::vector<double>>(5), in_order(5)),
            std::vector<double>(kWidth));
}

// Any thread may add, and nobody waits: the first band comes last.
TEST(OrderedSums, TakesRowsOfSeveralThreads) {
  constexpr int kRows = 4096, kBand = 16, kWorkers = 4;
  const auto rows = random_rows(kRows);
  OrderedSums sums(kRows, kWidth);
  const auto add_band = [&](int band) {
    for (int row = kBand * band; row < kBand * (band + 1); ++row) sums.add(row, rows[row]);
  };
  {
    std::vector<std::jthread> workers;
    for (int worker = 0; worker < kWorkers; ++worker) {
      workers.emplace_back([&, worker] {
        for (int band = 1 + worker; band < kRows / kBand; band += kWorkers) add_band(band);
      });
    }
  }
  add_band(0);
  EXPECT_EQ(sums.total(), total_in_order(rows, in_order(kRows)));
}

// One run of rows, however late its first: the roots of whole subtrees on its two sides, one a
// level, and the row that is being added.
TEST(OrderedSums, HoldsTwoNodesALevel) {
  constexpr int kRows = 4096, kLevels = 12;
  const auto rows = random_rows(kRows);
  OrderedSums sums(kRows, kWidth);
  for (int row = 1; row < kRows; ++row) sums.add(row, rows[row]);
  EXPECT_LE(sums.most_waiting(), 2U * kLevels + 1U);
  sums.add(0, rows[0]);
  EXPECT_EQ(sums.total(), total_in_order(rows, in_order(kRows)));
}

}  // namespace
}  // namespace shoal
