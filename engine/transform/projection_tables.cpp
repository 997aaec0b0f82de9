#include "transform/projection_tables.h"

#include <algorithm>

namespace shoal {

kernels::ColumnPhases column_phases(const EquirectGrid& grid) {
  const ColumnAngles angles = column_angles(grid);
  return {angles.first, angles.step, angles.turn, angles.edge_weight};
}

std::shared_ptr<const GridTables> ProjectionTables::get(const EquirectGrid& grid,
                                                        Quadrature quadrature, int degree) {
  const std::scoped_lock lock(mutex_);
  const auto fits = [&](const auto& tables) {
    const ProjectionWeights& weights = tables->weights;
    return weights.grid == grid && weights.quadrature == quadrature && weights.degree == degree;
  };
  const auto found = std::ranges::find_if(kept_, fits);
  if (found != kept_.end()) {
    kept_.splice(kept_.begin(), kept_, found);
    return kept_.front();
  }
  // Made under the lock: two workers that meet a new size together need the tables once.
  auto tables = std::make_shared<GridTables>();
  tables->weights = make_projection_weights(grid, quadrature, degree);
  tables->moments = kernels::make_row_moment_plan(grid.width, degree, column_phases(grid));
  kept_.push_front(std::move(tables));
  if (kept_.size() > kKept) kept_.pop_back();
  return kept_.front();
}

}  // namespace shoal
