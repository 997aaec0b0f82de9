// Pictures in every other layout: sums over texels that look in any directions.
#pragma once

#include <memory>
#include <optional>

#include "sphere/texel_geometry.h"
#include "transform/ordered_sums.h"
#include "transform/picture_sums.h"
#include "transform/reference_projector.h"

namespace shoal {

// A texel's value stands for the light of its solid angle, taken to come from its centre: the
// midpoint rule, whichever quadrature is asked for. Its error falls with the square of the size.
//
// Order-invariant: the sums of a scanline are added in a tree of a fixed shape. Directions are made
// scanline by scanline, so that memory does not grow with the picture.
class DirectionSums final : public PictureSums {
 public:
  DirectionSums(const PictureInfo& info, const ProjectionSettings& settings,
                const TexelGeometry& geometry);

  [[nodiscard]] bool shareable() const override { return !reference_; }
  [[nodiscard]] Texel texel(int row, int column) const override {
    return geometry_.texel(row, column);
  }
  [[nodiscard]] double solid_angle(int row, int column) const override {
    return texel(row, column).solid_angle;
  }
  void change(std::span<const TexelChange> changes) override;
  // The mean is weighted by solid angle.
  [[nodiscard]] PictureTotals totals() override;

 private:
  struct Scanline;

  void add_rows(const RowBand& band, ProjectionWorker& worker) override;

  void add_scanline(const RowBand& band, int row, ProjectionWorker& worker);
  void sum_by_kernel(const Scanline& scanline, ProjectionWorker& worker) const;
  void sum_by_reference(const Scanline& scanline, ProjectionWorker& worker);
  [[nodiscard]] OnClamp clamp_record(const Scanline& scanline, ProjectionWorker& worker) const;

  TexelGeometry geometry_;
  kernels::DirectionPlan plan_;
  int channel_count_;
  // Of a scanline: (channel_count, (L+1)^2) sums, the flux that the clamp took from each channel,
  // and the solid angle.
  std::size_t flux_offset_;
  OrderedSums sums_;
  std::vector<double> changes_;  // (channel_count, (L+1)^2), or none
  std::optional<DirectionReference> reference_;
};

}  // namespace shoal
