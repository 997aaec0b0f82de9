// What the workers of one panorama add to, each in its own way by the picture's layout.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "core/aligned_buffer.h"
#include "core/row_band.h"
#include "image/panorama_source.h"
#include "kernels/direction_moments.h"
#include "kernels/row_moments.h"
#include "sphere/coefficients.h"
#include "sphere/quadrature.h"
#include "sphere/texel_mappings.h"
#include "transform/bright_texels.h"
#include "transform/pixel_policy.h"
#include "transform/projection_settings.h"

namespace shoal {

// What one worker holds while it works on one panorama.
struct ProjectionWorker {
  PixelTally tally;
  kernels::RowMomentScratch scratch;
  kernels::DirectionScratch direction_scratch;
  std::vector<kernels::SampleRange> ranges;
  AlignedBuffer<float> samples;     // (3, width): one scanline as floats
  AlignedBuffer<float> directions;  // (4, width): x, y, z, solid angle of one scanline
  std::vector<double> sums;         // of one scanline
  std::vector<BrightTexel> bright;  // of some rows
};

struct PictureTotals {
  Coefficients radiance;              // native frame, in the file's own colours
  std::optional<Coefficients> finer;  // the same to quality_degree, where that is higher
  std::array<double, kMaxChannels> mean{};
  std::array<double, kMaxChannels> clamped_flux{};
  double solid_angle = 0.0;
  std::int64_t pixel_count = 0;
  Quadrature quadrature = Quadrature::texel;  // the one really used
};

// A texel that is other than it was when it was added: picture row and column.
struct TexelChange {
  std::int32_t row = 0;
  std::int32_t column = 0;
  std::array<float, kMaxChannels> from{};
  std::array<float, kMaxChannels> to{};
};

// Where a scanline's first sample lies in the picture, and where the others go from there.
[[nodiscard]] ScanlinePlace scanline_place(const PictureInfo& info, int scanline);

class PictureSums {
 public:
  virtual ~PictureSums() = default;

  // Whether several workers may add at once.
  [[nodiscard]] virtual bool shareable() const = 0;

  // Before the first band: hands `bright` the brightest texels of every band.
  void watch(BrightTexels* bright) { bright_ = bright; }

  // Adds all rows of a band, each of which comes once.
  void add(const RowBand& band, ProjectionWorker& worker);

  // Where a texel looks, and its weight in the integral over the sphere, which alone is quicker.
  [[nodiscard]] virtual Texel texel(int row, int column) const = 0;
  [[nodiscard]] virtual double solid_angle(int row, int column) const = 0;

  // After all bands: what the texels would have added, in double arithmetic. Each once, by row and
  // column.
  virtual void change(std::span<const TexelChange> changes) = 0;

  // After all bands. Channels that the file does not have are as the first.
  [[nodiscard]] virtual PictureTotals totals() = 0;

 protected:
  PictureSums(const PictureInfo& info, const ProjectionSettings& settings)
      : info_(info), settings_(settings) {}

  virtual void add_rows(const RowBand& band, ProjectionWorker& worker) = 0;

  // Gathers the bright texels of a row as they are before any clamp. Without ranges, of every row.
  void look_at(const RowBand& band, int row, const ScanlinePlace& place,
               std::span<const kernels::SampleRange> ranges, ProjectionWorker& worker) const;

  // Whether samples of such a range are other than ordinary light, which nearly all are.
  [[nodiscard]] bool needs_policy(std::span<const kernels::SampleRange> ranges) const;

  // A row of a band as floats, tallied, and with the policy applied.
  PolicyRow treat(const RowBand& band, int row, const ScanlinePlace& place, const OnClamp& on_clamp,
                  ProjectionWorker& worker) const;

  // The same as a band of its own for a kernel, scaled by `scale` where its ranges say that sums of
  // its samples may leave the range of floats.
  struct TreatedBand {
    RowBand band;
    double scale = 1.0;
  };
  TreatedBand treat_for_kernel(const RowBand& band, int row, const ScanlinePlace& place,
                               std::span<const kernels::SampleRange> ranges,
                               const OnClamp& on_clamp, ProjectionWorker& worker) const;

  const PictureInfo& info_;
  const ProjectionSettings settings_;

 private:
  void hand_over(ProjectionWorker& worker) const;

  BrightTexels* bright_ = nullptr;
};

}  // namespace shoal
