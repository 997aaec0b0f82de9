#include "kernels/byte_planes.h"

#include <cstdint>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "kernels/byte_planes.cpp"
#include <hwy/foreach_target.h>  // compiles this file once a target; must come before highway.h
#include <hwy/highway.h>

#include "kernels/dispatch.h"

HWY_BEFORE_NAMESPACE();
namespace shoal::kernels::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

// With every in[i] - 128 taken modulo 256, t[i] = sum of in[0..i] + 128 i: a running sum of plain
// bytes whose odd elements get their top bit flipped.
inline std::uint8_t finished(std::uint8_t running_sum, std::size_t index) {
  return static_cast<std::uint8_t>(running_sum ^ ((index & 1) << 7));
}

// The elements [done, half) of both halves, given the running sums before them.
void undo_plainly(const std::uint8_t* in, std::size_t size, std::size_t done, std::uint8_t sum_even,
                  std::uint8_t sum_odd, std::uint8_t* out) {
  const std::size_t half = (size + 1) / 2;
  for (std::size_t k = done; k < half; ++k) {
    sum_even = static_cast<std::uint8_t>(sum_even + in[k]);
    out[2 * k] = finished(sum_even, k);
    if (half + k == size) break;
    sum_odd = static_cast<std::uint8_t>(sum_odd + in[half + k]);
    out[2 * k + 1] = finished(sum_odd, half + k);
  }
}

#if HWY_TARGET == HWY_SCALAR

void UndoPredictorAndSplit(const std::uint8_t* in, std::size_t size, std::uint8_t* out) {
  const std::size_t half = (size + 1) / 2;
  std::uint8_t sum_odd = 0;
  for (std::size_t k = 0; k < half; ++k) sum_odd = static_cast<std::uint8_t>(sum_odd + in[k]);
  undo_plainly(in, size, 0, 0, sum_odd, out);
}

#else

using Bytes = hn::FixedTag<std::uint8_t, 16>;
using Block = hn::Vec<Bytes>;

// The running sum within a block, in four doubling steps.
HWY_INLINE Block running_sum(Block v) {
  const Bytes d;
  v = hn::Add(v, hn::ShiftLeftBytes<1>(d, v));
  v = hn::Add(v, hn::ShiftLeftBytes<2>(d, v));
  v = hn::Add(v, hn::ShiftLeftBytes<4>(d, v));
  return hn::Add(v, hn::ShiftLeftBytes<8>(d, v));
}

HWY_INLINE Block broadcast_last(Block v) {
  return hn::TableLookupBytes(v, hn::Set(Bytes(), std::uint8_t{15}));
}

std::uint8_t sum_of(const std::uint8_t* in, std::size_t size) {
  const Bytes d;
  const hn::Repartition<std::uint64_t, Bytes> d64;
  auto sums = hn::Zero(d64);
  std::size_t i = 0;
  for (; i + 16 <= size; i += 16) sums = hn::Add(sums, hn::SumsOf8(hn::LoadU(d, in + i)));
  auto sum = static_cast<std::uint8_t>(hn::GetLane(hn::SumOfLanes(d64, sums)));
  for (; i < size; ++i) sum = static_cast<std::uint8_t>(sum + in[i]);
  return sum;
}

// Both halves advance together, 16 elements a step, so that their carries, each a chain of an
// addition and a broadcast, overlap, and their bytes leave interleaved without a second pass.
void UndoPredictorAndSplit(const std::uint8_t* in, std::size_t size, std::uint8_t* out) {
  const Bytes d;
  const std::size_t half = (size + 1) / 2;
  const std::uint8_t* odd = in + half;
  alignas(16) static constexpr std::uint8_t kFlipOdd[16] = {0, 128, 0, 128, 0, 128, 0, 128,
                                                            0, 128, 0, 128, 0, 128, 0, 128};
  const Block flip_even = hn::Load(d, kFlipOdd);
  const Block flip_odd =
      half % 2 == 0 ? flip_even : hn::Xor(flip_even, hn::Set(d, std::uint8_t{128}));
  Block carry_even = hn::Zero(d);
  Block carry_odd = hn::Set(d, sum_of(in, half));
  std::size_t k = 0;
  for (; k + 16 <= size - half; k += 16) {
    const Block even_sum = hn::Add(running_sum(hn::LoadU(d, in + k)), carry_even);
    const Block odd_sum = hn::Add(running_sum(hn::LoadU(d, odd + k)), carry_odd);
    carry_even = broadcast_last(even_sum);
    carry_odd = broadcast_last(odd_sum);
    const Block a = hn::Xor(even_sum, flip_even);
    const Block b = hn::Xor(odd_sum, flip_odd);
    hn::StoreU(hn::InterleaveLower(d, a, b), d, out + 2 * k);
    hn::StoreU(hn::InterleaveUpper(d, a, b), d, out + 2 * k + 16);
  }
  undo_plainly(in, size, k, hn::GetLane(carry_even), hn::GetLane(carry_odd), out);
}

#endif

}  // namespace shoal::kernels::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace shoal::kernels {

SHOAL_KERNEL_TABLE(UndoPredictorAndSplit);

void undo_predictor_and_split(std::byte* in, std::size_t size, std::byte* out) {
  if (size == 0) return;
  SHOAL_CALL_KERNEL(UndoPredictorAndSplit)
  (reinterpret_cast<const std::uint8_t*>(in), size, reinterpret_cast<std::uint8_t*>(out));
}

}  // namespace shoal::kernels
#endif
