// Scanlines of a picture gathered into the lines of a smaller one.
//
// Accuracy: 32 scanlines at the most are summed in single precision, the rest is double: the
// relative error of a mean is below 2.2e-6 of the mean of magnitudes.
#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "core/aligned_buffer.h"
#include "core/row_band.h"
#include "kernels/row_moments.h"
#include "transform/area_weights.h"

namespace shoal {

// One scanline as floats.
struct Scanline {
  AlignedBuffer<float> samples;  // (channel_count, sample_count)
  std::vector<float> present;    // empty, or 0 where a texel is left out and 1 elsewhere
};

// Row `row` of the band. Texels with a channel that is not finite are left out.
void read_scanline(const RowBand& band, int row, kernels::RowMomentScratch& scratch,
                   Scanline& scanline);

// Leaves out the texels before `begin` and from `end` on, of `width`, as well.
void keep_only(int begin, int end, int width, Scanline& scanline);

// Takes scanlines in whatever order they come. They may be rows or columns; "samples" run along
// them.
class ScanlineMeans {
 public:
  // `lines`: the shares of each scanline; `samples`: of each sample in one.
  ScanlineMeans(int channel_count, std::vector<AreaShare> lines, std::vector<AreaShare> samples,
                int line_count, int samples_per_line);

  void add(int index, const Scanline& scanline);
  void finish();  // after the last

  // Of one texel; black where nothing was present.
  [[nodiscard]] double mean(int channel, int line, int sample) const;
  [[nodiscard]] bool has_light(int line, int sample) const;

 private:
  // The sum of some scanlines that belong to one line.
  struct LineSum {
    int line = -1;
    int scanline_count = 0;
    float whole_weight = 0.0F;     // of the scanlines without a texel that is left out
    bool has_gaps = false;         // `present` counts as well
    AlignedBuffer<float> samples;  // (channel_count, sample_count)
    AlignedBuffer<float> present;  // (sample_count): weights of the other scanlines' texels

    void clear(int new_line);
  };

  // One more than there are, for the share behind the last, which is 0.
  [[nodiscard]] std::size_t plane_size() const { return samples_per_line_ + std::size_t{1}; }
  [[nodiscard]] std::size_t plane(int channel, int line) const {
    return (static_cast<std::size_t>(line) * (channel_count_ + 1) + channel) * plane_size();
  }
  void add_to(int line, float weight, const Scanline& scanline);
  void fold(const LineSum& sum);
  void fold_plane(std::span<const float> from, float more, double* to) const;

  int channel_count_;
  std::vector<AreaShare> lines_;
  std::vector<AreaShare> samples_;
  int samples_per_line_;
  std::array<LineSum, 2> sums_;
  std::vector<double> means_;  // (lines, channel_count + 1, plane_size): sums, and their weights
};

}  // namespace shoal
