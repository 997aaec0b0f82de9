// Equirect pictures: row moments into a moment table, contracted at the end.
#pragma once

#include <memory>
#include <optional>

#include "transform/moment_table.h"
#include "transform/picture_sums.h"
#include "transform/projection_tables.h"
#include "transform/reference_projector.h"

namespace shoal {

[[nodiscard]] EquirectGrid grid_of(const PictureInfo& info);

// Order-invariant: every slot of the moment table is written once, by whichever worker has its row.
class EquirectSums final : public PictureSums {
 public:
  EquirectSums(const PictureInfo& info, const ProjectionSettings& settings,
               ProjectionTables& tables);

  [[nodiscard]] bool shareable() const override;
  [[nodiscard]] Texel texel(int row, int column) const override;
  [[nodiscard]] double solid_angle(int row, int column) const override;
  void change(std::span<const TexelChange> changes) override;
  [[nodiscard]] PictureTotals totals() override;

 private:
  void add_rows(const RowBand& band, ProjectionWorker& worker) override;
  void change_moments(std::span<const TexelChange> changes);
  void change_reference(const TexelChange& change);
  [[nodiscard]] kernels::MomentSlots slots_from(int row);
  [[nodiscard]] OnClamp clamp_record(const ScanlinePlace& place, int width);
  void project_rows(const RowBand& band, ProjectionWorker& worker);
  void reproject_row(const RowBand& band, int row, ProjectionWorker& worker);
  void add_column(int column, const PolicyRow& treated);
  void add_to_reference(int scanline, const PolicyRow& treated);
  [[nodiscard]] Coefficients contracted(const ProjectionWeights& weights) const;
  [[nodiscard]] Coefficients finer_than(const Coefficients& radiance) const;

  EquirectGrid grid_;
  std::shared_ptr<const GridTables> tables_;
  // Tables, and a reference, to the highest degree that is asked for. The weights of a low degree
  // depend on the degree that they are made for, by a rounding, hence both.
  std::shared_ptr<const GridTables> finest_tables_;
  MomentTable moments_;       // to the highest degree
  MomentTable clamped_away_;  // degree 0: what the clamp took from each row
  std::optional<ReferenceProjector> reference_;
  std::optional<ReferenceProjector> finest_reference_;  // where that is higher
};

}  // namespace shoal
