// The tables that panoramas of one size share, made once and kept for the next of that size.
#pragma once

#include <list>
#include <memory>
#include <mutex>

#include "kernels/row_moments.h"
#include "sphere/quadrature.h"

namespace shoal {

// What projecting on one grid needs; immutable.
struct GridTables {
  ProjectionWeights weights;
  kernels::RowMomentPlan moments;
};

// A small cache of GridTables, safe to share between threads.
class ProjectionTables {
 public:
  std::shared_ptr<const GridTables> get(const EquirectGrid& grid, Quadrature quadrature,
                                        int degree);

 private:
  // A library has a handful of sizes, and at most two degrees each; more would only hold memory.
  static constexpr std::size_t kKept = 8;

  std::mutex mutex_;
  std::list<std::shared_ptr<const GridTables>> kept_;  // the one used last in front
};

// The same columns in the kernels' terms.
[[nodiscard]] kernels::ColumnPhases column_phases(const EquirectGrid& grid);

}  // namespace shoal
