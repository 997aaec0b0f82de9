// Every kernel in bytes of samples and in pixels a second, beside a memcpy of the same bytes.
#include <benchmark/benchmark.h>
#include <half.h>

#include <algorithm>
#include <cstring>
#include <numeric>

#include "bench/panorama_painter.h"
#include "image/map_writer.h"
#include "kernels/byte_planes.h"
#include "kernels/direction_moments.h"
#include "kernels/row_moments.h"

namespace shoal::bench {
namespace {

constexpr int kWidth = 4096;
constexpr int kRows = 16;  // as a ZIP chunk has
constexpr std::size_t kSamples = std::size_t{kWidth} * kRows;

// Rows of a painted panorama in one of the sample types, planar.
struct PaintedBand {
  RowBand band;
  std::vector<std::byte> bytes;
};

void store_rgbe(const std::vector<float>& samples, std::byte* out) {
  for (std::size_t i = 0; i < kSamples; ++i) {
    const auto texel = encode_rgbe(samples[i], samples[kSamples + i], samples[2 * kSamples + i]);
    for (std::size_t c = 0; c < 4; ++c) out[c * kSamples + i] = std::byte{texel[c]};
  }
}

void store(SampleType type, const std::vector<float>& samples, std::byte* out) {
  if (type == SampleType::rgbe_floor || type == SampleType::rgbe_center) {
    store_rgbe(samples, out);
    return;
  }
  for (const float sample : samples) {
    const half narrow(sample);
    const auto whole = static_cast<std::uint32_t>(std::min(sample, 1e5F) * 4e4F);
    const void* bytes = &sample;
    if (type == SampleType::half) bytes = &narrow;
    if (type == SampleType::uint32) bytes = &whole;
    std::memcpy(out, bytes, sample_size(type));
    out += sample_size(type);
  }
}

PaintedBand paint_band(SampleType type) {
  std::vector<float> samples(3 * kSamples);
  PanoramaPainter painter(kWidth, kWidth / 2, 1);
  for (int row = 0; row < kRows; ++row) {
    float* first = samples.data() + std::ptrdiff_t{row} * kWidth;
    painter.paint_row(kWidth / 4 + row, {first, first + kSamples, first + 2 * kSamples});
  }
  PaintedBand painted;
  const std::size_t plane = kSamples * sample_size(type);
  const bool has_exponents = sample_size(type) == 1;
  painted.bytes.resize((has_exponents ? 4 : 3) * plane);
  store(type, samples, painted.bytes.data());
  painted.band = {0, kRows, kWidth, 3, {}, {}};
  const auto stride = static_cast<std::ptrdiff_t>(kWidth * sample_size(type));
  for (std::size_t c = 0; c < 3; ++c) {
    painted.band.channels[c] = {painted.bytes.data() + c * plane, stride, type};
  }
  if (has_exponents) painted.band.exponent = {painted.bytes.data() + 3 * plane, stride, type};
  return painted;
}

void count_work(benchmark::State& state, std::size_t bytes, std::size_t pixels) {
  state.SetBytesProcessed(state.iterations() * static_cast<std::int64_t>(bytes));
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(pixels));
}

void row_moments_of(benchmark::State& state, SampleType type) {
  const PaintedBand painted = paint_band(type);
  const auto plan =
      kernels::make_row_moment_plan(kWidth, static_cast<int>(state.range(0)), {1, 2, 2 * kWidth});
  kernels::RowMomentScratch scratch;
  std::vector<double> moments(std::size_t{3} * plan.moment_count() * kRows);
  std::vector<kernels::SampleRange> ranges(std::size_t{3} * kRows);
  const kernels::MomentSlots slots = {moments.data(), plan.moment_count() * std::ptrdiff_t{kRows},
                                      kRows};
  for (auto iteration : state) {
    kernels::row_moments(plan, painted.band, scratch, slots, ranges);
    benchmark::DoNotOptimize(moments.data());
    benchmark::ClobberMemory();
  }
  count_work(state, painted.bytes.size(), kSamples);
}

// The same rows through the kernel of layouts that do not factor; where the texels look makes no
// difference to the time.
void direction_moments_of(benchmark::State& state, SampleType type) {
  const PaintedBand painted = paint_band(type);
  const auto plan = kernels::make_direction_plan(static_cast<int>(state.range(0)));
  kernels::DirectionScratch scratch;
  std::vector<double> sums(std::size_t{3} * plan.coefficient_count());
  std::vector<kernels::SampleRange> ranges(3);
  const std::vector<float> third(kWidth, 0.57735F);
  const kernels::TexelDirections directions = {third.data(), third.data(), third.data(),
                                               third.data()};
  for (auto iteration : state) {
    for (int row = 0; row < kRows; ++row) {
      kernels::direction_moments(plan, painted.band, row, directions, scratch, sums, ranges);
    }
    benchmark::DoNotOptimize(sums.data());
    benchmark::ClobberMemory();
  }
  count_work(state, painted.bytes.size(), kSamples);
}

void widen_rows_of(benchmark::State& state, SampleType type) {
  const PaintedBand painted = paint_band(type);
  kernels::RowMomentScratch scratch;
  std::vector<float> row(kWidth);
  for (auto iteration : state) {
    for (int i = 0; i < kRows; ++i) {
      for (int c = 0; c < 3; ++c) kernels::widen_row(painted.band, i, c, scratch, row.data());
    }
    benchmark::DoNotOptimize(row.data());
    benchmark::ClobberMemory();
  }
  count_work(state, painted.bytes.size(), kSamples);
}

void copy_samples_of(benchmark::State& state, SampleType type) {
  const PaintedBand painted = paint_band(type);
  std::vector<std::byte> copy(painted.bytes.size());
  for (auto iteration : state) {
    std::memcpy(copy.data(), painted.bytes.data(), copy.size());
    benchmark::DoNotOptimize(copy.data());
    benchmark::ClobberMemory();
  }
  count_work(state, painted.bytes.size(), kSamples);
}

// The bytes of a chunk of half samples; what they are makes no difference to the time.
void undo_predictor_and_split(benchmark::State& state) {
  PaintedBand painted = paint_band(SampleType::half);
  std::vector<std::byte> out(painted.bytes.size());
  for (auto iteration : state) {
    kernels::undo_predictor_and_split(painted.bytes.data(), painted.bytes.size(), out.data());
    benchmark::DoNotOptimize(out.data());
    benchmark::ClobberMemory();
  }
  count_work(state, painted.bytes.size(), kSamples);
}

// Pixels are rows of one channel here; bytes are the floats that come out.
void synthesise_row(benchmark::State& state) {
  const auto plan =
      kernels::make_row_moment_plan(kWidth, static_cast<int>(state.range(0)), {1, 2, 2 * kWidth});
  std::vector<double> moments(plan.moment_count());
  std::iota(moments.begin(), moments.end(), 1.0);
  kernels::RowMomentScratch scratch;
  std::vector<float> row(kWidth);
  for (auto iteration : state) {
    kernels::synthesise_row(plan, moments, scratch, row.data());
    benchmark::DoNotOptimize(row.data());
    benchmark::ClobberMemory();
  }
  count_work(state, row.size() * sizeof(float), row.size());
}

BENCHMARK_CAPTURE(copy_samples_of, half, SampleType::half);
BENCHMARK_CAPTURE(copy_samples_of, float32, SampleType::float32);
BENCHMARK_CAPTURE(copy_samples_of, rgbe, SampleType::rgbe_floor);
BENCHMARK_CAPTURE(widen_rows_of, half, SampleType::half);
BENCHMARK_CAPTURE(widen_rows_of, float32, SampleType::float32);
BENCHMARK_CAPTURE(widen_rows_of, uint32, SampleType::uint32);
BENCHMARK_CAPTURE(widen_rows_of, rgbe, SampleType::rgbe_floor);
BENCHMARK_CAPTURE(row_moments_of, half, SampleType::half)->Arg(2)->Arg(10)->Arg(32);
BENCHMARK_CAPTURE(row_moments_of, float32, SampleType::float32)->Arg(2)->Arg(10)->Arg(32);
BENCHMARK_CAPTURE(row_moments_of, uint32, SampleType::uint32)->Arg(2)->Arg(10)->Arg(32);
BENCHMARK_CAPTURE(row_moments_of, rgbe_floor, SampleType::rgbe_floor)->Arg(2)->Arg(10)->Arg(32);
BENCHMARK_CAPTURE(row_moments_of, rgbe_center, SampleType::rgbe_center)->Arg(2)->Arg(10)->Arg(32);
BENCHMARK_CAPTURE(direction_moments_of, half, SampleType::half)->Arg(2)->Arg(10)->Arg(32);
BENCHMARK_CAPTURE(direction_moments_of, rgbe_floor, SampleType::rgbe_floor)
    ->Arg(2)
    ->Arg(10)
    ->Arg(32);
BENCHMARK(synthesise_row)->Arg(2)->Arg(10)->Arg(32);
BENCHMARK(undo_predictor_and_split);

}  // namespace
}  // namespace shoal::bench
