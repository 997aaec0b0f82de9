#include "kernels/row_moments.h"

#include <algorithm>
#include <array>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "kernels/row_moments.cpp"
#include <hwy/foreach_target.h>  // compiles this file once a target; must come before highway.h
#include <hwy/highway.h>

#include "kernels/dispatch.h"
#include "kernels/low_degree_moments-inl.h"
#include "kernels/moment_sums-inl.h"
#include "kernels/row_fold-inl.h"

HWY_BEFORE_NAMESPACE();
namespace shoal::kernels::HWY_NAMESPACE {

inline constexpr int kStreamsPerChannel = 4;

template <typename Samples>
void gather_fourfold(const Samples& samples, std::size_t width, std::size_t begin, std::size_t end,
                     float* const* streams, RunningRange& range) {
  const FloatTag tag;
  const std::size_t half = width / 2;
  RangeTracker tracker(range);
  std::size_t k = begin;
  for (; k + kLanes <= end; k += kLanes) {
    const auto f = fold_columns(samples, width, k, tracker);
    hn::Store(f.even_cosine, tag, streams[0] + (k - begin));
    hn::Store(f.odd_cosine, tag, streams[1] + (k - begin));
    hn::Store(f.even_sine, tag, streams[2] + (k - begin));
    hn::Store(f.odd_sine, tag, streams[3] + (k - begin));
  }
  tracker.store();
  for (; k < end; ++k) {
    const float a = samples.one(k);
    const float b = samples.one(half - 1 - k);
    const float c = samples.one(half + k);
    const float d = samples.one(width - 1 - k);
    for (const float value : {a, b, c, d}) range.see_one(value);
    const auto f = fold(a, b, c, d, std::plus<float>(), std::minus<float>());
    streams[0][k - begin] = f.even_cosine;
    streams[1][k - begin] = f.odd_cosine;
    streams[2][k - begin] = f.even_sine;
    streams[3][k - begin] = f.odd_sine;
  }
}

template <typename Samples>
void gather_plain(const Samples& samples, std::size_t begin, std::size_t end, float* stream,
                  RunningRange& range) {
  RangeTracker tracker(range);
  std::size_t k = begin;
  for (; k + kLanes <= end; k += kLanes) {
    const FloatVec v = samples.vector(k);
    tracker.see(v);
    hn::Store(v, FloatTag(), stream + (k - begin));
  }
  tracker.store();
  for (; k < end; ++k) {
    const float v = samples.one(k);
    range.see_one(v);
    stream[k - begin] = v;
  }
}

// Fills the streams of one channel with columns [begin, end), and zeros up to a whole group.
void gather(const RowMomentPlan& plan, const RowBand& band, int row, int channel,
            const float* scales, std::size_t begin, std::size_t end, float* const* streams,
            RunningRange& range) {
  with_samples(band, row, channel, scales, [&](const auto& samples) {
    if (plan.symmetry == Symmetry::four_fold) {
      gather_fourfold(samples, static_cast<std::size_t>(plan.width), begin, end, streams, range);
    } else {
      gather_plain(samples, begin, end, streams[0], range);
    }
  });
  const int stream_count = plan.symmetry == Symmetry::four_fold ? kStreamsPerChannel : 1;
  for (int s = 0; s < stream_count; ++s) {
    for (std::size_t k = end - begin; k % kVirtualLanes != 0; ++k) streams[s][k] = 0.0F;
  }
}

// sums[t][c][lane] += sum over the segment of tables[t] * streams[t][c], in double per virtual
// lane.
//
// Groups of 16 columns; up to 8 groups are added in a row, the four such runs of a segment
// pairwise. That keeps the longest chain of single-precision additions short without any cost in
// speed: the products of kTables * kChannels independent chains are in flight at once.
template <int kTables, int kChannels>
struct SegmentSums {
  using Accumulators = FloatVec[kTables][kChannels];

  const float* tables[kTables];
  const float* streams[kTables][kChannels];
  double* sums[kTables][kChannels];

  HWY_INLINE void add_run(std::size_t group, std::size_t group_end, std::size_t lane,
                          Accumulators& run) const {
    const FloatTag tag;
    for (auto& channel : run) std::fill(std::begin(channel), std::end(channel), hn::Zero(tag));
    for (; group < group_end; ++group) {
      const std::size_t at = group * kVirtualLanes + lane;
      for (int t = 0; t < kTables; ++t) {
        const FloatVec trig = hn::LoadU(tag, tables[t] + at);
        for (int c = 0; c < kChannels; ++c) {
          run[t][c] = hn::Add(run[t][c], hn::Mul(hn::Load(tag, streams[t][c] + at), trig));
        }
      }
    }
  }

  HWY_INLINE void add_pair_of_runs(std::size_t group, std::size_t group_count, std::size_t lane,
                                   Accumulators& pair) const {
    Accumulators second;
    add_run(std::min(group, group_count), std::min(group + 8, group_count), lane, pair);
    add_run(std::min(group + 8, group_count), std::min(group + 16, group_count), lane, second);
    for (int t = 0; t < kTables; ++t) {
      for (int c = 0; c < kChannels; ++c) pair[t][c] = hn::Add(pair[t][c], second[t][c]);
    }
  }

  void add_segment(std::size_t group_count) const {
    for (std::size_t lane = 0; lane < kVirtualLanes; lane += kLanes) {
      Accumulators low;
      Accumulators high;
      add_pair_of_runs(0, group_count, lane, low);
      add_pair_of_runs(16, group_count, lane, high);
      for (int t = 0; t < kTables; ++t) {
        for (int c = 0; c < kChannels; ++c) {
          carry(hn::Add(low[t][c], high[t][c]), sums[t][c] + lane);
        }
      }
    }
  }
};

// All orders of one segment. streams: (kChannels, 4, kSegment); sums: (kChannels, 2L+1, 16).
template <int kChannels>
void accumulate(const RowMomentPlan& plan, std::size_t begin, std::size_t end, const float* streams,
                double* sums) {
  const std::size_t group_count = (end - begin + kVirtualLanes - 1) / kVirtualLanes;
  const bool folded = plan.symmetry == Symmetry::four_fold;
  const auto stream = [&](int channel, int index) {
    return streams + (channel * kStreamsPerChannel + (folded ? index : 0)) * kSegment;
  };
  const auto sum = [&](int channel, int moment) {
    return sums + (channel * plan.moment_count() + moment) * kVirtualLanes;
  };
  SegmentSums<1, kChannels> mean;
  mean.tables[0] = plan.cosines.data() + begin;
  for (int c = 0; c < kChannels; ++c) {
    mean.streams[0][c] = stream(c, 0);
    mean.sums[0][c] = sum(c, 0);
  }
  mean.add_segment(group_count);
  for (int m = 1; m <= plan.degree; ++m) {
    SegmentSums<2, kChannels> order;
    order.tables[0] = plan.cosines.data() + m * plan.padded_length + begin;
    order.tables[1] = plan.sines.data() + m * plan.padded_length + begin;
    for (int c = 0; c < kChannels; ++c) {
      order.streams[0][c] = stream(c, m % 2);
      order.streams[1][c] = stream(c, 2 + m % 2);
      order.sums[0][c] = sum(c, m);
      order.sums[1][c] = sum(c, plan.degree + m);
    }
    order.add_segment(group_count);
  }
}

// One row by streams: any degree, any columns. Fills the channels' sums and ranges.
void row_by_streams(const RowMomentPlan& plan, const RowBand& band, int row,
                    RowMomentScratch& scratch, std::span<RunningRange> running) {
  scratch.streams.resize_uninitialised(kMaxChannels * kStreamsPerChannel * kSegment);
  for (std::size_t begin = 0; begin < plan.stream_length; begin += kSegment) {
    const std::size_t end = std::min(begin + kSegment, plan.stream_length);
    for (int c = 0; c < band.channel_count; ++c) {
      std::array<float*, kStreamsPerChannel> streams;
      for (int s = 0; s < kStreamsPerChannel; ++s) {
        streams[s] = scratch.streams.data() + (c * kStreamsPerChannel + s) * kSegment;
      }
      gather(plan, band, row, c, scratch.scales.data(), begin, end, streams.data(), running[c]);
    }
    const auto all_orders = band.channel_count == 1 ? accumulate<1> : accumulate<kMaxChannels>;
    all_orders(plan, begin, end, scratch.streams.data(), scratch.sums.data());
  }
}

void row_in_registers(const RowMomentPlan& plan, const RowBand& band, int row,
                      RowMomentScratch& scratch, std::span<RunningRange> running) {
  for (int c = 0; c < band.channel_count; ++c) {
    double* sums = scratch.sums.data() + c * plan.moment_count() * kVirtualLanes;
    with_samples(band, row, c, scratch.scales.data(),
                 [&](const auto& samples) { low_degree_moments(plan, samples, sums, running[c]); });
  }
}

void RowMoments(const RowMomentPlan& plan, const RowBand& band, RowMomentScratch& scratch,
                const MomentSlots& slots, std::span<SampleRange> ranges) {
  const int channels = band.channel_count;
  const auto fill = fits_registers(plan) ? row_in_registers : row_by_streams;
  for (int row = 0; row < band.row_count(); ++row) {
    scratch.sums.resize_zeroed(static_cast<std::size_t>(channels) * plan.moment_count() *
                               kVirtualLanes);
    std::array<RunningRange, kMaxChannels> running;
    prepare_scales(band, row, scratch.scales);
    fill(plan, band, row, scratch, running);
    for (int c = 0; c < channels; ++c) {
      with_samples(band, row, c, scratch.scales.data(), [&](const auto& samples) {
        ranges[static_cast<std::size_t>(row) * channels + c] =
            reduce_range(running[c], samples, static_cast<std::size_t>(plan.width));
      });
      double* sums = scratch.sums.data() + c * plan.moment_count() * kVirtualLanes;
      double* slot = slots.first + c * slots.channel_stride + row;
      for (int k = 0; k < plan.moment_count(); ++k) {
        slot[k * slots.moment_stride] = reduce_lanes(sums + k * kVirtualLanes);
      }
    }
  }
}

}  // namespace shoal::kernels::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
#include <cmath>
#include <numbers>

namespace shoal::kernels {

SHOAL_KERNEL_TABLE(RowMoments);

namespace {

// The narrowest width at which folding pays, and at which reversed vectors stay inside the row.
constexpr int kMinFoldedWidth = 64;

bool columns_come_in_fours(int width, const ColumnPhases& phases) {
  return width % 4 == 0 && width >= kMinFoldedWidth && phases.step == 2 * phases.first &&
         phases.turn == width * phases.step && phases.edge_weight == 1.0;
}

}  // namespace

RowMomentPlan make_row_moment_plan(int width, int degree, const ColumnPhases& phases) {
  RowMomentPlan plan;
  plan.width = width;
  plan.degree = degree;
  if (columns_come_in_fours(width, phases)) plan.symmetry = Symmetry::four_fold;
  plan.stream_length =
      static_cast<std::size_t>(plan.symmetry == Symmetry::four_fold ? width / 4 : width);
  plan.padded_length = (plan.stream_length + 15) / 16 * 16;
  plan.cosines.resize_zeroed((degree + 1) * plan.padded_length);
  plan.sines.resize_zeroed((degree + 1) * plan.padded_length);
  for (int m = 0; m <= degree; ++m) {
    for (std::size_t j = 0; j < plan.stream_length; ++j) {
      // The angle is reduced in integers, so that a high order costs no accuracy. Long double,
      // because libraries choose their double functions by the processor, and the bits with them.
      const std::int64_t phase =
          (phases.first + phases.step * static_cast<std::int64_t>(j)) * m % phases.turn;
      const long double angle = 2.0L * std::numbers::pi_v<long double> *
                                static_cast<long double>(phase) /
                                static_cast<long double>(phases.turn);
      const bool at_edge = j == 0 || j + 1 == static_cast<std::size_t>(width);
      const long double weight = at_edge ? phases.edge_weight : 1.0;
      plan.cosines[m * plan.padded_length + j] = static_cast<float>(weight * std::cos(angle));
      plan.sines[m * plan.padded_length + j] = static_cast<float>(weight * std::sin(angle));
    }
  }
  return plan;
}

void row_moments(const RowMomentPlan& plan, const RowBand& band, RowMomentScratch& scratch,
                 const MomentSlots& slots, std::span<SampleRange> ranges) {
  SHOAL_CALL_KERNEL(RowMoments)(plan, band, scratch, slots, ranges);
}

}  // namespace shoal::kernels
#endif
