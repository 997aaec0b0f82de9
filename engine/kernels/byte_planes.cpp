#include "kernels/byte_planes.h"

#include <cstdint>
#include <cstring>

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

// The samples [done, count), given the sum before them.
template <typename Sample>
void sum_planes_plainly(const std::uint8_t* planes, std::size_t plane_count, std::size_t count,
                        std::size_t done, Sample sum, std::uint8_t* out) {
  for (std::size_t i = done; i < count; ++i) {
    for (std::size_t plane = 0; plane < plane_count; ++plane) {
      const std::size_t shift = 8 * (sizeof sum - 1 - plane);
      sum = static_cast<Sample>(sum + (std::uint32_t{planes[plane * count + i]} << shift));
    }
    std::memcpy(out + i * sizeof sum, &sum, sizeof sum);
  }
}

#if HWY_TARGET == HWY_SCALAR

void SumPlanes(const std::uint8_t* planes, std::size_t plane_count, std::size_t count,
               std::uint8_t* out) {
  if (plane_count == 2) {
    sum_planes_plainly<std::uint16_t>(planes, 2, count, 0, 0, out);
  } else {
    sum_planes_plainly<std::uint32_t>(planes, plane_count, count, 0, 0, out);
  }
}

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

using Halves = hn::FixedTag<std::uint16_t, 8>;
using Words = hn::FixedTag<std::uint32_t, 4>;

// Stores the running sums within `v` on top of `carry`, and returns the last one in all lanes.
HWY_INLINE hn::Vec<Halves> store_sums(hn::Vec<Halves> v, hn::Vec<Halves> carry, std::uint8_t* out) {
  const Halves d;
  v = hn::Add(v, hn::ShiftLeftLanes<1>(d, v));
  v = hn::Add(v, hn::ShiftLeftLanes<2>(d, v));
  v = hn::Add(v, hn::ShiftLeftLanes<4>(d, v));
  v = hn::Add(v, carry);
  hn::StoreU(hn::BitCast(Bytes(), v), Bytes(), out);
  const auto last = hn::BitCast(Bytes(), hn::Set(d, std::uint16_t{0x0f0e}));
  return hn::BitCast(d, hn::TableLookupBytes(hn::BitCast(Bytes(), v), last));
}

HWY_INLINE hn::Vec<Words> store_sums(hn::Vec<Words> v, hn::Vec<Words> carry, std::uint8_t* out) {
  const Words d;
  v = hn::Add(v, hn::ShiftLeftLanes<1>(d, v));
  v = hn::Add(v, hn::ShiftLeftLanes<2>(d, v));
  v = hn::Add(v, carry);
  hn::StoreU(hn::BitCast(Bytes(), v), Bytes(), out);
  return hn::Broadcast<3>(v);
}

void sum_two_planes(const std::uint8_t* planes, std::size_t count, std::uint8_t* out) {
  const Bytes d;
  auto carry = hn::Zero(Halves());
  std::size_t i = 0;
  for (; i + 16 <= count; i += 16) {
    const Block high = hn::LoadU(d, planes + i);
    const Block low = hn::LoadU(d, planes + count + i);
    const auto first = hn::BitCast(Halves(), hn::InterleaveLower(d, low, high));
    const auto second = hn::BitCast(Halves(), hn::InterleaveUpper(d, low, high));
    carry = store_sums(first, carry, out + 2 * i);
    carry = store_sums(second, carry, out + 2 * i + 16);
  }
  sum_planes_plainly<std::uint16_t>(planes, 2, count, i, hn::GetLane(carry), out);
}

void sum_more_planes(const std::uint8_t* planes, std::size_t plane_count, std::size_t count,
                     std::uint8_t* out) {
  const Bytes d;
  const Halves halves;
  const Words words;
  auto carry = hn::Zero(words);
  std::size_t i = 0;
  for (; i + 16 <= count; i += 16) {
    const Block a = hn::LoadU(d, planes + i);
    const Block b = hn::LoadU(d, planes + count + i);
    const Block c = hn::LoadU(d, planes + 2 * count + i);
    const Block e = plane_count == 4 ? hn::LoadU(d, planes + 3 * count + i) : hn::Zero(d);
    const auto high0 = hn::BitCast(halves, hn::InterleaveLower(d, b, a));
    const auto high1 = hn::BitCast(halves, hn::InterleaveUpper(d, b, a));
    const auto low0 = hn::BitCast(halves, hn::InterleaveLower(d, e, c));
    const auto low1 = hn::BitCast(halves, hn::InterleaveUpper(d, e, c));
    std::uint8_t* to = out + 4 * i;
    carry = store_sums(hn::BitCast(words, hn::InterleaveLower(halves, low0, high0)), carry, to);
    carry =
        store_sums(hn::BitCast(words, hn::InterleaveUpper(halves, low0, high0)), carry, to + 16);
    carry =
        store_sums(hn::BitCast(words, hn::InterleaveLower(halves, low1, high1)), carry, to + 32);
    carry =
        store_sums(hn::BitCast(words, hn::InterleaveUpper(halves, low1, high1)), carry, to + 48);
  }
  sum_planes_plainly<std::uint32_t>(planes, plane_count, count, i, hn::GetLane(carry), out);
}

void SumPlanes(const std::uint8_t* planes, std::size_t plane_count, std::size_t count,
               std::uint8_t* out) {
  if (plane_count == 2) return sum_two_planes(planes, count, out);
  sum_more_planes(planes, plane_count, count, out);
}

#endif

}  // namespace shoal::kernels::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace shoal::kernels {

SHOAL_KERNEL_TABLE(UndoPredictorAndSplit);
SHOAL_KERNEL_TABLE(SumPlanes);

void undo_predictor_and_split(std::byte* in, std::size_t size, std::byte* out) {
  if (size == 0) return;
  SHOAL_CALL_KERNEL(UndoPredictorAndSplit)
  (reinterpret_cast<const std::uint8_t*>(in), size, reinterpret_cast<std::uint8_t*>(out));
}

void sum_planes(const std::byte* planes, std::size_t plane_count, std::size_t count,
                std::byte* out) {
  SHOAL_CALL_KERNEL(SumPlanes)
  (reinterpret_cast<const std::uint8_t*>(planes), plane_count, count,
   reinterpret_cast<std::uint8_t*>(out));
}

}  // namespace shoal::kernels
#endif
