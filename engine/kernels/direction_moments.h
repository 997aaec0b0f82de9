// Spherical-harmonic sums over texels that look in any directions: the kernel of layouts whose rows
// do not factor into Fourier sums (cube faces, angular map, mirror ball, octahedral).
//
//   M_lm = sum_j w_j I[j] Y_lm(x_j, y_j, z_j),    l = 0..L, |m| <= l
//
// with Y_lm as in sphere/conventions.h. Bits do not depend on the SIMD target: products are made in
// single precision and added as in row_moments.h.
// Accuracy, for directions as given: |error of M_lm| <= 2 (l + 8) u sqrt((2l+1)/(4 pi)) sqrt(2) *
// sum_j |w_j I[j]|, u = 2^-24. The recurrences make about l + 1 steps, each with a few roundings of
// numbers no larger than the basis' own bound; the sums at most nine more.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "core/aligned_buffer.h"
#include "core/row_band.h"
#include "kernels/row_moments.h"

namespace shoal::kernels {

// The constants of the basis recurrence to one degree; immutable, shared by all workers. By order m
// first, then by degree l = m..L.
struct DirectionPlan {
  int degree = 0;
  std::vector<float> near;  // the factor of z times the value at l - 1; 0 at l = m
  std::vector<float> far;  // the factor of the value at l - 2, to be subtracted; at l = m the value

  [[nodiscard]] int coefficient_count() const { return (degree + 1) * (degree + 1); }
};

// Precondition: 0 <= degree <= 64.
[[nodiscard]] DirectionPlan make_direction_plan(int degree);

// One row of texels, planar: unit directions in the native frame and solid angles in sr. Each array
// holds as many numbers as the row has texels.
struct TexelDirections {
  const float* x = nullptr;
  const float* y = nullptr;
  const float* z = nullptr;
  const float* solid_angle = nullptr;
};

// The scratch of one worker, reused from call to call.
struct DirectionScratch {
  AlignedBuffer<float> block;
  AlignedBuffer<float> scales;  // of a row's Radiance texels
};

// The sums of one row of a band: `sums` has the shape (channel_count, (degree+1)^2), index
// l(l+1)+m; `ranges` holds channel_count. The caller adds rows in an order of its own.
void direction_moments(const DirectionPlan& plan, const RowBand& band, int row,
                       const TexelDirections& directions, DirectionScratch& scratch,
                       std::span<double> sums, std::span<SampleRange> ranges);

}  // namespace shoal::kernels
