// Row moments: the Fourier sums of picture rows, and their adjoint, the synthesis of rows.
//
//   C_m = sum_j w_j I[j] cos(m phi_j),  m = 0..L        S_m = sum_j w_j I[j] sin(m phi_j),  m
//   = 1..L
//
// Bits do not depend on the SIMD target: products are made and added in single precision in a fixed
// number of virtual lanes, at most eight in a row, then pairwise by a fixed tree, and carried to
// double after 512 columns at the latest.
// Accuracy: |error of a moment| <= 8e-7 * sum_j |I[j] trig_j| + 1e-15 * sum_j |I[j]|. Table and
// product round once each (2u, u = 2^-24), the four-fold symmetry adds two roundings, the sums at
// most nine: 13u = 7.8e-7. The second term is for columns where the sine is zero but for the
// rounding of pi.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "core/aligned_buffer.h"
#include "core/row_band.h"

namespace shoal::kernels {

// phi_j = 2 pi (first + step j) / turn. The first and last column weigh edge_weight, the others 1.
struct ColumnPhases {
  std::int64_t first = 1;
  std::int64_t step = 2;
  std::int64_t turn = 2;
  double edge_weight = 1.0;
};

// Which symmetry of the columns the tables use.
enum class Symmetry {
  none,       // any columns
  four_fold,  // columns come in fours phi, pi - phi, pi + phi, -phi: 1/4 of the products
};

// The tables of one (width, degree, columns); immutable, shared by all workers.
struct RowMomentPlan {
  int width = 0;
  int degree = 0;
  Symmetry symmetry = Symmetry::none;
  std::size_t stream_length = 0;  // width, or a quarter of it
  std::size_t padded_length = 0;  // rounded up to the virtual lanes; the padding holds zeros
  AlignedBuffer<float> cosines;   // (degree+1, padded_length)
  AlignedBuffer<float> sines;     // (degree+1, padded_length); m = 0 is all zero

  [[nodiscard]] int moment_count() const { return 2 * degree + 1; }
};

// C_m is moment m, S_m is moment degree + m.
[[nodiscard]] RowMomentPlan make_row_moment_plan(int width, int degree, const ColumnPhases& phases);

// Where moments go: slot(c, k, r) = first[c * channel_stride + k * moment_stride + r], r counting
// the rows of the band.
struct MomentSlots {
  double* first = nullptr;
  std::ptrdiff_t channel_stride = 0;
  std::ptrdiff_t moment_stride = 0;
};

// What one row of one channel holds. With non-finite samples only magnitude_bits means anything.
struct SampleRange {
  float minimum = 0.0F;
  float maximum = 0.0F;
  std::uint32_t magnitude_bits = 0;  // the largest |sample|, as the bits of a float

  [[nodiscard]] bool finite() const { return magnitude_bits < 0x7F800000U; }
};

// The scratch of one worker, reused from call to call.
struct RowMomentScratch {
  AlignedBuffer<float> streams;
  AlignedBuffer<double> sums;
  AlignedBuffer<float> scales;  // of a row's Radiance texels
};

// Moments and ranges of all rows of a band. `ranges` has the shape (row_count, channel_count).
// Precondition: band.width == plan.width. A sum of samples near the largest float may overflow; the
// caller sees by magnitude_bits and scales.
void row_moments(const RowMomentPlan& plan, const RowBand& band, RowMomentScratch& scratch,
                 const MomentSlots& slots, std::span<SampleRange> ranges);

// The adjoint: out[j] = sum_m a_m cos(m phi_j) + b_m sin(m phi_j) of one row of one channel, with
// `moments` = (a_0..a_L, b_1..b_L). Edge weights play no part. Accuracy: (2L+4) u * sum of |a| and
// |b|. `out` holds plan.width floats.
void synthesise_row(const RowMomentPlan& plan, std::span<const double> moments,
                    RowMomentScratch& scratch, float* out);

// One row of one channel as floats: half and RGBE exactly, uint32 to nearest.
void widen_row(const RowBand& band, int row, int channel, RowMomentScratch& scratch, float* out);

}  // namespace shoal::kernels
